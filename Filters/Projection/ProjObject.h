#pragma once

#include <memory>
#include <string>

struct pj_ctx; // PROJ's PJ_CONTEXT
struct PJconsts; // PROJ's PJ

namespace pointfront
{

/// A PROJ context that keeps what PROJ complains of instead of printing it.
/// Threads   one thread at a time.
class ProjContext
{
public:
  ProjContext();
  ~ProjContext();
  ProjContext(const ProjContext&) = delete;
  ProjContext& operator=(const ProjContext&) = delete;

  pj_ctx* get() const { return context_; }
  /// PROJ's message since the last call, "" if there is none; forgets it.
  std::string takeMessage() const;

private:
  pj_ctx* context_;
  mutable std::string message_;
};

struct ProjDestroy
{
  void operator()(PJconsts* object) const;
};
/// Must not outlive its context.
using ProjObject = std::unique_ptr<PJconsts, ProjDestroy>;

} // namespace pointfront
