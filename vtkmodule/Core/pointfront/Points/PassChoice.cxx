#include "pointfront/Points/PassChoice.h"

#include <mutex>

namespace pointfront
{
namespace
{
struct Registered
{
  std::mutex mutex;
  std::shared_ptr<const AttributePassMaker> maker;
};

Registered& registered()
{
  static Registered* instance = new Registered; // libraries register while others are unloaded
  return *instance;
}
} // namespace

void AttributePassMaker::use(std::shared_ptr<const AttributePassMaker> maker)
{
  const std::lock_guard<std::mutex> lock(registered().mutex);
  registered().maker = std::move(maker);
}

std::shared_ptr<const AttributePassMaker> AttributePassMaker::ofProcess()
{
  const std::lock_guard<std::mutex> lock(registered().mutex);
  return registered().maker;
}

} // namespace pointfront
