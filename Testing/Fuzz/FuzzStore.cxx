#include "BytesAsFile.h"

#include "pointfront/Store/PointStore.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const fuzz::BytesAsFile file(data, size);
  const Result<std::shared_ptr<const PointStore>> store = PointStore::open(file.path());
  if (!store)
  {
    fuzz::require(!store.error().what.empty(), "an Error says what happened");
    return 0;
  }
  if (const Result<VerifyReport> verified = (*store)->verify(); !verified)
  {
    fuzz::require(!verified.error().what.empty(), "an Error says what happened");
  }
  return 0;
}
