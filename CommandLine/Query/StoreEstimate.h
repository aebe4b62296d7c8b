#pragma once

#include "SourceInfo.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pointfront
{

/// An estimate of what a store of a point file and pictures of it take, before anything is built.
/// Ranges   least and most of what was measured for docs/tradeoffs.md; null where it was not: the
///          time of a build from other formats than LAS and LAZ. A store that is given normals, or
///          less memory, takes longer.
/// Keys     store_bytes, build_seconds, build_memory_bytes, first_picture and complete_picture
///          (milliseconds, bytes_read, and of the complete one technique, error_px and
///          memory_bytes), source.
nlohmann::ordered_json estimateJson(const SourceInfo& info);
/// For people: lines that follow those of sourceText().
std::string estimateText(const SourceInfo& info);

} // namespace pointfront
