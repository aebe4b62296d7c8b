#include "pointfront/Points/PointFileOpener.h"

#include <mutex>

namespace pointfront
{
namespace
{
struct OpenerOfProcess
{
  std::mutex mutex;
  std::shared_ptr<const PointFileOpener> opener;
};

OpenerOfProcess& registeredOpener()
{
  // Never taken down: libraries register while others are unloaded.
  static OpenerOfProcess* instance = new OpenerOfProcess;
  return *instance;
}
} // namespace

void PointFileOpener::use(std::shared_ptr<const PointFileOpener> opener)
{
  const std::lock_guard<std::mutex> lock(registeredOpener().mutex);
  registeredOpener().opener = std::move(opener);
}

std::shared_ptr<const PointFileOpener> PointFileOpener::ofProcess()
{
  const std::lock_guard<std::mutex> lock(registeredOpener().mutex);
  return registeredOpener().opener;
}

} // namespace pointfront
