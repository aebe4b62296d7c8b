#include "ModuleSymbol.h"

#include <dlfcn.h>

#include <string>

namespace pointfront
{

Result<void*> moduleSymbol(const char* library, const char* symbol, const char* what)
{
  void* const loaded = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const found = loaded != nullptr ? ::dlsym(loaded, symbol) : nullptr;
  if (found == nullptr)
  {
    const char* const reason = ::dlerror();
    return makeError(
      Error::Kind::Unsupported, std::string(what) + ": " + (reason != nullptr ? reason : library));
  }
  return found;
}

} // namespace pointfront
