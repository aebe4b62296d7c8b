#include "pointfront/Residency/StoreNodes.h"

#include <new>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
/// Errors of the file as a whole, not of a node in it: one tells of all.
bool isOfTheFile(const Error& error)
{
  return error.kind == Error::Kind::Unreadable || error.kind == Error::Kind::Truncated ||
    error.kind == Error::Kind::NotFound;
}
} // namespace

/// A file that cannot be read fails for every node: told once, until a read succeeds again.
void StoreNodes::report(Error error)
{
  if (isOfTheFile(error))
  {
    if (std::exchange(fileFailed_, true))
    {
      return;
    }
    error.what += " (other parts of this file that cannot be read are not listed)";
  }
  errors_.push_back(std::move(error));
}

void StoreNodes::countFailed(CachedNode& cached)
{
  cached.failed = true;
  cached.stale = false;
  ++failed_;
  ++arrivals_;
  ++revision_;
}

void StoreNodes::markFailed(CachedNode& cached, Error error)
{
  countFailed(cached);
  report(std::move(error));
}

/// For lack of memory: there may be none for the words either.
void StoreNodes::markLacking(CachedNode& cached)
{
  countFailed(cached);
  try
  {
    report(makeError(Error::Kind::NoMemory, "no memory to keep a node that was read"));
  }
  catch (const std::bad_alloc&)
  {
    return; // it is counted
  }
}

void StoreNodes::markTooLarge(NodeIndex node, std::size_t bytes, std::size_t limit)
{
  CachedNode& cached = cache_[node];
  cached.tooLarge = true;
  markFailed(cached,
    makeError(Error::Kind::NoMemory,
      "node " + std::to_string(node) + " takes " + std::to_string(bytes) +
        " bytes in memory, more than the whole budget of " + std::to_string(limit) +
        ": give more memory"));
}

} // namespace pointfront
