#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pointfront
{

/// Facts of a store about itself, without reading points: the keys of `info --json`.
nlohmann::ordered_json storeJson(const StoreDescription& store, const Hierarchy& hierarchy);
/// For people: one line a fact.
std::string storeText(const StoreDescription& store, const Hierarchy& hierarchy);

} // namespace pointfront
