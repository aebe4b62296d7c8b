#include "EpochOption.h"

#include "pointfront/Disk/Epoch.h"

#include <CLI/CLI.hpp>

#include <functional>

namespace pointfront
{
namespace
{
void declare(CLI::App& app, const std::function<void(const std::string&)>& take)
{
  app
    .add_option_function<std::string>("--epoch", take, "Collections: the tiles of this epoch alone")
    ->type_name("NAME");
}
} // namespace

void declareEpoch(CLI::App& app, std::vector<std::string>& clouds)
{
  declare(app,
    [&clouds](const std::string& epoch)
    {
      for (std::string& cloud : clouds)
      {
        cloud = EpochAddress{ cloud, epoch }.text();
      }
    });
}

void declareEpoch(CLI::App& app, std::string& cloud)
{
  declare(app, [&cloud](const std::string& epoch) { cloud = EpochAddress{ cloud, epoch }.text(); });
}

} // namespace pointfront
