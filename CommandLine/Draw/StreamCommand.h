#pragma once

#include "Command.h"
#include "DrawingOptions.h"
#include "SoftwareScene.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace pointfront
{

/// `pointfront stream`: frames for another program, in software. A line of JSON on stdin asks for a
/// frame; a line of JSON on stdout and the frame's bytes behind it are the answer.
/// docs/user/command-line.md describes both.
/// Ends     when stdin does.
/// Threads  one.
class StreamCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  /// A frame looks as these say, besides the points that have arrived.
  struct Shown
  {
    Camera camera;
    std::array<int, 2> size{};
    bool moving = false;

    bool operator==(const Shown& other) const
    {
      return camera == other.camera && size == other.size && moving == other.moving;
    }
  };

  Result<void> obey(const std::string& line);
  Result<void> resize(const nlohmann::json& request);
  Result<void> move(const nlohmann::json& request);
  /// False when `waitMs` passed and a frame would show what the last one did.
  bool waitForNews(double waitMs);
  /// `frame`: that was drawn, or null when there is no other than the last one; `further`: keys of
  /// what was asked besides.
  Result<void> answer(const FrameRecord* frame, const nlohmann::ordered_json& further);
  Result<nlohmann::ordered_json> pick(const nlohmann::json& place);
  nlohmann::ordered_json legend() const;

  DrawingOptions drawing_;
  std::unique_ptr<SoftwareScene> scene_;
  Camera camera_;
  std::optional<Shown> shown_; ///< by the last frame
  bool settled_ = false; ///< when it was last waited: nothing was on its way
};

} // namespace pointfront
