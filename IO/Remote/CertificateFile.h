#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// Returns the file of the authorities that vouch for servers, or an empty text where libcurl's own
/// choice is right. The variables CURL_CA_BUNDLE and SSL_CERT_FILE choose first. Where neither is
/// set and libcurl's file is not there, it is the first file that another system keeps: a wheel
/// brings the libcurl of the system that built it to systems that keep the file elsewhere.
/// Threads  any.
std::string certificateFile();

/// Returns an empty text if `own` is empty or a file, else the first of `others` that is a file, or
/// an empty text if none is.
std::string certificatesInPlaceOf(const std::string& own, const std::vector<std::string>& others);

} // namespace pointfront
