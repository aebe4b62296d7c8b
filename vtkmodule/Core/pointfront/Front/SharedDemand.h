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
/// what it takes at which threshold, and asks what the others take: the threshold that fits all of
/// them together is then the same for all, so the memory goes to the largest errors on screen,
/// and a scene that needs more settles at the best error that every view can have.
/// Budgets  a claim is made under a budget (in any unit; 0: none). After that was lowered the views
///          come down one after the other, each before it draws: what those that are yet to come
///          down have at this moment does not count for those that do, only what they will take.
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
    /// What all others take.
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
    /// How many views share.
    std::uint64_t claims() const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      return shared_->claims_.size();
    }
    /// Changes whenever a claim does.
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
