#pragma once

namespace pointfront
{

/// Adds what is opened in place to the formats of this process: indices of LAS files, COPC, EPT,
/// and folders of LAS and LAZ files at a glance. Again is once.
void addCloudFormats();

} // namespace pointfront
