#include "CertificateFile.h"

#include <curl/curl.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace pointfront
{
namespace
{
bool isFile(const std::string& path)
{
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

/// The file that libcurl was built to read, or an empty text if it reads none.
std::string ownFile()
{
  const curl_version_info_data* const built = curl_version_info(CURLVERSION_NOW);
  // Libraries of before 7.70 do not tell.
  const bool tells = built != nullptr && built->age >= CURLVERSION_SEVENTH;
  return tells && built->cainfo != nullptr ? built->cainfo : "";
}
} // namespace

std::string certificatesInPlaceOf(const std::string& own, const std::vector<std::string>& others)
{
  if (own.empty() || isFile(own))
  {
    return {};
  }
  for (const std::string& other : others)
  {
    if (isFile(other))
    {
      return other;
    }
  }
  return {};
}

std::string certificateFile()
{
  for (const char* name : { "CURL_CA_BUNDLE", "SSL_CERT_FILE" })
  {
    const char* const value = std::getenv(name);
    if (value != nullptr && *value != '\0')
    {
      return value;
    }
  }
  static const std::string found = certificatesInPlaceOf(ownFile(),
    {
      "/etc/ssl/certs/ca-certificates.crt", // Debian, Ubuntu, Arch, Gentoo, Alpine
      "/etc/pki/tls/certs/ca-bundle.crt", // Fedora, RHEL 6 to 9
      "/etc/pki/ca-trust/extracted/pem/tls-ca-bundle.pem", // RHEL, Fedora from 43
      "/etc/ssl/ca-bundle.pem", // openSUSE
      "/etc/ssl/cert.pem", // Alpine, BSDs, macOS
    });
  return found;
}

} // namespace pointfront
