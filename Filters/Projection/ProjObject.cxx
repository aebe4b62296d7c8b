#include "ProjObject.h"

#include <proj.h>

#include <dlfcn.h>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
/// The folder `proj` beside the library that this code is in, if it holds PROJ's database: a wheel
/// brings its own. Empty: PROJ looks where it always looks.
std::string databaseBesideThis()
{
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&databaseBesideThis), &here) == 0)
  {
    return {};
  }
  const std::filesystem::path folder = std::filesystem::path(here.dli_fname).parent_path() / "proj";
  std::error_code none;
  return std::filesystem::exists(folder / "proj.db", none) ? folder.string() : std::string();
}
} // namespace

ProjContext::ProjContext()
  : context_(proj_context_create())
{
  if (const std::string folder = databaseBesideThis(); !folder.empty())
  {
    const char* path = folder.c_str();
    proj_context_set_search_paths(context_, 1, &path);
  }
  proj_log_level(context_, PJ_LOG_ERROR);
  proj_log_func(context_, &message_,
    [](void* kept, int, const char* text) { *static_cast<std::string*>(kept) = text; });
}

ProjContext::~ProjContext()
{
  proj_context_destroy(context_);
}

std::string ProjContext::takeMessage() const
{
  return std::exchange(message_, std::string());
}

void ProjDestroy::operator()(PJconsts* object) const
{
  proj_destroy(object);
}

} // namespace pointfront
