#pragma once

#include "Command.h"

#include "pointfront/Collection/CollectionWriter.h"

#include <string>
#include <vector>

namespace pointfront
{

/// `pointfront collection create|add|replace|remove|list|verify|undo|compact`: a file that opens
/// thousands of tiles as one cloud, and its changes.
class CollectionCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  void checkWords() const;
  /// Adds to `warnings` what folders leave out.
  Result<std::vector<TileRequest>> requests(std::vector<std::string>& warnings) const;
  Result<CollectionReport> change(const CollectionOptions& options) const;
  Result<void> list() const;
  Result<void> verify() const;

  std::string what_;
  std::string path_;
  std::vector<std::string> tiles_;
  std::string epoch_;
  std::string name_;
  std::string progress_ = "auto";
  bool replace_ = false;
  bool json_ = false;
};

} // namespace pointfront
