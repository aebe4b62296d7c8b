#include "pointfront/Points/PassChoice.h"

#include <mutex>

namespace pointfront
{
namespace
{
struct MakerOfProcess
{
  std::mutex mutex;
  std::shared_ptr<const AttributePassMaker> maker;
};

MakerOfProcess& registeredMaker()
{
  // Never taken down: libraries register while others are unloaded.
  static MakerOfProcess* instance = new MakerOfProcess;
  return *instance;
}
} // namespace

void AttributePassMaker::use(std::shared_ptr<const AttributePassMaker> maker)
{
  const std::lock_guard<std::mutex> lock(registeredMaker().mutex);
  registeredMaker().maker = std::move(maker);
}

std::shared_ptr<const AttributePassMaker> AttributePassMaker::ofProcess()
{
  const std::lock_guard<std::mutex> lock(registeredMaker().mutex);
  return registeredMaker().maker;
}

} // namespace pointfront
