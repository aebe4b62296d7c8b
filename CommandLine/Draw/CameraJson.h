#pragma once

#include "Camera.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pointfront
{

/// Errors  NotFound, Unreadable; BadFormat with the byte offset where the text stops being JSON.
Result<nlohmann::json> readJsonFile(const std::string& path);

/// `where` begins the message of an Error: the file, and which entry of it.
Result<Camera> cameraFromJson(const nlohmann::json& object, const std::string& where);
/// As cameraFromJson() reads it: the same camera, to the last bit.
nlohmann::ordered_json jsonOf(const Camera& camera);

} // namespace pointfront
