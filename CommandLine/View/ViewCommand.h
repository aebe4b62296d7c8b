#pragma once

#include "Command.h"
#include "ViewRequest.h"

#include <string>

namespace pointfront
{

/// `pointfront view`: stores in a window, moved by mouse and keyboard. The window is that of a
/// library which is loaded for it (see moduleSymbol()).
class ViewCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  ViewRequest request_;
  std::string view_ = "iso";
  std::string cameraPath_;
};

} // namespace pointfront
