#pragma once

#include "Command.h"

#include "pointfront/Store/StoredCloud.h"

#include <string>

namespace pointfront
{

/// `pointfront info`: what a store says of itself, without reading points.
class InfoCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string path_;
  bool json_ = false;
};

/// The keys of `info --json`.
std::string storeJson(const StoreDescription& store, const Hierarchy& hierarchy);
/// For people: one line a fact.
std::string storeText(const StoreDescription& store, const Hierarchy& hierarchy);

} // namespace pointfront
