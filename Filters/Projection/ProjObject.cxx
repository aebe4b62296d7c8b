#include "ProjObject.h"

#include <proj.h>

#include <utility>

namespace pointfront
{

ProjContext::ProjContext()
  : context_(proj_context_create())
{
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
