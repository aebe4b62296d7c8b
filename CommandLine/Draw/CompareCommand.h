#pragma once

#include "Command.h"

#include "pointfront/Picture/PictureComparison.h"

#include <array>
#include <optional>
#include <string>

namespace pointfront
{

/// `pointfront compare`: how far a picture is from another, and from the mask of what it shows.
class CompareCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string drawnPath_;
  std::string referencePath_;
  std::string maskPath_; ///< empty: none
  std::optional<std::array<std::uint8_t, 3>> background_;
  bool json_ = false;
};

/// The keys of `compare --json`. `psnr` is null where no compared pixel differs; `holes`, `bloat`
/// and `background` are null without a mask or a background.
std::string comparisonJson(const PictureComparison& comparison);
std::string comparisonText(const PictureComparison& comparison);

} // namespace pointfront
