#pragma once

#include "pointfront/Front/DemandCurve.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// The demand of all views that share a memory (of the process, of a window's GPU). Each view tells
/// its demand at each threshold, and asks for the demand of the others. The threshold at which all
/// views fit together is then the same for all. So the memory goes to the largest errors on screen,
/// and a scene that needs more settles at the best error that every view can have.
/// Budgets  a claim is made under a budget (in any unit; 0: none). After the budget was lowered the
///          views come down one after the other, each before it draws. For a view that comes down,
///          the present holdings of views that are yet to come down do not count, only what they
///          will take.
/// Threads  any.
class SharedDemand
{
public:
  /// One view's part. Destruction withdraws it.
  class Claim
  {
  public:
    explicit Claim(std::shared_ptr<SharedDemand> shared)
      : shared_(std::move(shared))
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      shared_->claims_.push_back(this);
    }
    ~Claim()
    {
      set(DemandCurve());
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      std::vector<const Claim*>& all = shared_->claims_;
      all.erase(std::find(all.begin(), all.end(), this));
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

    void set(const DemandCurve& own, std::uint64_t budget = 0)
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      if (!(own == own_) || budget != budget_)
      {
        budget_ = budget;
        shared_->total_.subtract(own_);
        shared_->total_.add(own);
        own_ = own;
        ++shared_->revision_;
      }
    }
    /// The demand of all others.
    void elsewhere(DemandCurve& others, std::uint64_t budget = 0) const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      others = shared_->total_;
      others.subtract(own_);
      for (const Claim* claim : shared_->claims_)
      {
        const bool comesDown = budget > 0 && (claim->budget_ == 0 || claim->budget_ > budget);
        others[0] -= claim != this && comesDown ? claim->own_[0] : 0;
      }
    }
    /// Number of views that share.
    std::uint64_t claims() const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      return shared_->claims_.size();
    }
    /// Changes whenever a claim changes.
    std::uint64_t revision() const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      return shared_->revision_;
    }

  private:
    const std::shared_ptr<SharedDemand> shared_;
    DemandCurve own_;
    std::uint64_t budget_ = 0; ///< that it was made under
  };

private:
  std::mutex mutex_;
  DemandCurve total_;
  std::uint64_t revision_ = 1;
  std::vector<const Claim*> claims_;
};

} // namespace pointfront
