#pragma once

#include "ProjObject.h"

#include "pointfront/Reference/CoordinateSystems.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pointfront
{

/// A transformation between two systems in PROJ's hands. PROJ's objects serve one thread at a time:
/// each thread borrows a copy with a context of its own, made when there is none to spare.
class ProjTransform final : public CoordinateTransform
{
public:
  /// Both systems have the same number of axes and belong to `context`, which is taken over in
  /// case of success. `where`: extent in `from`, may be empty.
  /// Error BadArgument: PROJ knows no way from one to the other, with its reason.
  static Result<std::unique_ptr<CoordinateTransform>> create(std::unique_ptr<ProjContext>& context,
    const PJconsts* from, const PJconsts* to, const Bounds& where);

  Result<void> apply(glm::dvec3* points, std::size_t count) const override;
  const std::vector<std::string>& warnings() const override { return warnings_; }

private:
  /// The objects that one thread works with.
  struct Copy
  {
    ProjContext context;
    ProjObject object;
  };

  ProjTransform(std::unique_ptr<ProjContext> context, ProjObject object, std::string names)
    : context_(std::move(context))
    , object_(std::move(object))
    , names_(std::move(names))
  {
  }
  std::unique_ptr<Copy> borrow() const;
  void giveBack(std::unique_ptr<Copy> copy) const;

  std::unique_ptr<ProjContext> context_;
  ProjObject object_; ///< never used but copied, under the mutex
  std::string names_; ///< "A to B", for messages
  std::vector<std::string> warnings_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Copy>> spare_;
};

} // namespace pointfront
