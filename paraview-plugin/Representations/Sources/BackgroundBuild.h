#pragma once

#include "vtkSmartPointer.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

class vtkCommand;
class vtkPointFrontBuilder;

namespace pointfront
{

/// A builder at work on a thread of its own, so that ParaView renders meanwhile.
/// Errors   what the builder says, without what VTK puts before it, and with the property's name
///          for the tool's option
/// Threads  made, asked and destroyed on one thread
class BackgroundBuild
{
public:
  struct State
  {
    std::string phase; ///< "sorting" ...
    double fraction = 0.0;
    bool preview = false; ///< lies beside the store
    bool ended = false;
    bool built = false; ///< ended well
    bool cancelled = false; ///< ended because cancel() was called
    unsigned long errorCode = 0; ///< vtkErrorCode
    std::string error;
    std::vector<std::string> warnings;
  };

  /// Starts the builder, which nobody else may touch from now on. `order`: what it was asked for.
  BackgroundBuild(vtkSmartPointer<vtkPointFrontBuilder> builder, std::string order);
  /// Cancels, and waits until the build has removed what it wrote.
  ~BackgroundBuild();
  BackgroundBuild(const BackgroundBuild&) = delete;
  BackgroundBuild& operator=(const BackgroundBuild&) = delete;

  const std::string& order() const { return order_; }
  State state() const;
  /// The state as soon as the build has ended, or after that time.
  State waitFor(std::chrono::milliseconds longest);
  void cancel();

private:
  class Observer;
  void build();

  const vtkSmartPointer<vtkPointFrontBuilder> builder_;
  const std::string order_;
  mutable std::mutex mutex_; // guards what follows
  std::condition_variable changed_;
  State state_;
  bool cancel_ = false;
  std::thread thread_; // last: it uses all the others
};

} // namespace pointfront
