#pragma once

#include "Command.h"

#include <string>

namespace pointfront
{

/// `pointfront cache info|clear|verify`: what was fetched from addresses and lies on the disk.
class CacheCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string what_;
  bool json_ = false;
};

} // namespace pointfront
