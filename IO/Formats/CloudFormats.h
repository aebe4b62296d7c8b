#pragma once

namespace pointfront
{

/// Adds what is opened in place to the formats of this process: indices of LAS files, COPC, EPT,
/// and folders of LAS and LAZ files at a glance; and what opens addresses (http, https, s3), unless
/// the build leaves that out. Again is once.
void addCloudFormats();

} // namespace pointfront
