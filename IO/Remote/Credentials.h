#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The process learns what servers ask for: headers of requests, and addresses whose public forms
/// another process has made.
/// Text     a line each. "[https://host]" begins a server; each line below it is a header, such as
///          "Authorization: Bearer ...". "~0123456789abcdef ADDRESS" is an address; what precedes
///          it is the mark that stands for its user, password and query in its public form.
/// Later    texts replace what earlier ones said of a server.
/// Threads  any; a child of fork() knows what its parent was told.
/// Errors   BadArgument, without any part of the text.
Result<void> learnCredentials(const std::string& text);

/// As learnCredentials(), of POINTFRONT_FAR, by which programs tell their children: unlike a
/// command line, the environment of a process is for its user alone. Again is once.
Result<void> learnCredentialsOfEnvironment();

/// The headers for the server of an origin.
std::vector<std::string> headersFor(const std::string& origin);

} // namespace pointfront
