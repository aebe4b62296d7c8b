#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Adds what is opened in place to the formats of this process: indices of LAS files, COPC, EPT,
/// and folders of LAS and LAZ files at a glance; and what opens addresses (http, https, s3), unless
/// the build leaves that out. Again is once.
void addCloudFormats();

/// Tells the openers of addresses what servers ask for: headers by server, and addresses by their
/// marks, as in the environment's POINTFRONT_FAR (docs/user/remote.md). Errors  BadArgument;
/// Unsupported: the build opens files only.
Result<void> learnCredentialsOfServers(const std::string& text);

/// The text of POINTFRONT_FAR for a child that gets these words on its command line, public forms
/// of addresses among them: what is in this process's own environment, and the whole addresses.
std::string credentialsForChild(const std::vector<std::string>& words);

} // namespace pointfront
