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

/// The keys of `info --json`. `nodes` is the hierarchy's.
std::string storeJson(const StoreDescription& store, std::uint64_t nodes);
/// For people: one line a fact.
std::string storeText(const StoreDescription& store, std::uint64_t nodes);

} // namespace pointfront
