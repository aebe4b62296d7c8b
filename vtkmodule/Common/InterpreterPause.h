/// Long work called from Python, while other Python threads go on.
#ifndef InterpreterPause_h
#define InterpreterPause_h

#include "pointfrontCommonModule.h" // for the export macro

namespace pointfront
{

/// While it exists, the interpreter of Python in this process is free for other threads, if the
/// calling thread had it. VTK 9.1 wraps methods so that they keep it, and this library links no
/// Python: its functions are looked up in the process. Without Python nothing happens.
/// Threads  made, used and destroyed on one thread.
class POINTFRONTCOMMON_EXPORT InterpreterPause
{
public:
  InterpreterPause();
  ~InterpreterPause();
  InterpreterPause(const InterpreterPause&) = delete;
  InterpreterPause& operator=(const InterpreterPause&) = delete;

  /// The interpreter is the calling thread's again, until it ends: observers may be Python's.
  class POINTFRONTCOMMON_EXPORT Resumed
  {
  public:
    explicit Resumed(InterpreterPause& pause);
    ~Resumed();
    Resumed(const Resumed&) = delete;
    Resumed& operator=(const Resumed&) = delete;

    /// Runs Python's handlers of signals that have come. True if one of them, or an observer, has
    /// raised: the work is to end, and the caller sees the exception (KeyboardInterrupt).
    bool interrupted() const;

  private:
    InterpreterPause& pause_;
  };

private:
  void* thread_ = nullptr; ///< PyThreadState of the caller while it is released
};

} // namespace pointfront

#endif
