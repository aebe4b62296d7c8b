#pragma once

#include "Camera.h"

#include "JSONText.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pointfront
{

/// Errors  NotFound, Unreadable; BadFormat with the line and column where the text stops being
///         JSON, and what is expected there.
Result<JSONText> readJsonFile(const std::string& path);

/// `where` begins the message of an Error: the file, and which entry of it. `text`: what the object
/// is of, which makes the message name the line.
Result<Camera> cameraFromJson(
  const nlohmann::json& object, const std::string& where, const JSONText* text = nullptr);
/// As cameraFromJson() reads it: the same camera, to the last bit.
nlohmann::ordered_json jsonOf(const Camera& camera);

} // namespace pointfront
