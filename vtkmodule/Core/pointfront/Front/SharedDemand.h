#pragma once

#include "pointfront/Front/DemandCurve.h"

#include <cstdint>
#include <memory>
#include <mutex>

namespace pointfront
{

/// The demand of all views that share a memory (of the process, of a window's GPU). Each view tells
/// what it takes at which threshold, and asks what the others take: the threshold that fits all of
/// them together is then the same for all, so the memory goes to the largest errors on screen,
/// and a scene that needs more settles at the best error that every view can have.
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
      ++shared_->claims_;
    }
    ~Claim()
    {
      set(DemandCurve());
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      --shared_->claims_;
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

    void set(const DemandCurve& own)
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      if (!(own == own_))
      {
        shared_->total_.subtract(own_);
        shared_->total_.add(own);
        own_ = own;
        ++shared_->revision_;
      }
    }
    /// What all others take.
    void elsewhere(DemandCurve& others) const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      others = shared_->total_;
      others.subtract(own_);
    }
    /// How many views share.
    std::uint64_t claims() const
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex_);
      return shared_->claims_;
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
  };

private:
  std::mutex mutex_;
  DemandCurve total_;
  std::uint64_t revision_ = 1;
  std::uint64_t claims_ = 0;
};

} // namespace pointfront
