#pragma once

#include "Command.h"

namespace pointfront
{

/// `pointfront serve`: becomes the page of the Python package, with the words that follow. The
/// interpreter is the one that POINTFRONT_PYTHON names, or `python3`.
/// Errors  Unsupported: there is no interpreter, or it has not the package.
class ServeCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;
};

} // namespace pointfront
