#pragma once

#include "Command.h"

#include "pointfront/Store/StoredCloud.h"

#include <string>

namespace pointfront
{

/// `pointfront verify`: reads the whole store and checks all that the format promises.
class VerifyCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string path_;
  std::string progress_ = "auto";
  bool json_ = false;
};

/// The keys of `verify --json`; `first_error` is null when all is well.
std::string verifyReportJson(const VerifyReport& report);

} // namespace pointfront
