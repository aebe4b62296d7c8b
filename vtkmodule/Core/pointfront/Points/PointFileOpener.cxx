#include "pointfront/Points/PointFileOpener.h"

#include <mutex>

namespace pointfront
{
namespace
{
struct Registered
{
  std::mutex mutex;
  std::shared_ptr<const PointFileOpener> opener;
};

Registered& registered()
{
  static Registered* instance = new Registered; // libraries register while others are unloaded
  return *instance;
}
} // namespace

void PointFileOpener::use(std::shared_ptr<const PointFileOpener> opener)
{
  const std::lock_guard<std::mutex> lock(registered().mutex);
  registered().opener = std::move(opener);
}

std::shared_ptr<const PointFileOpener> PointFileOpener::ofProcess()
{
  const std::lock_guard<std::mutex> lock(registered().mutex);
  return registered().opener;
}

} // namespace pointfront
