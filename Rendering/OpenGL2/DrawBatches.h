#pragma once

#include <cstddef>
#include <deque>

namespace pointfront
{

/// Whether the GL of the current context is itself a program (GL_RENDERER llvmpipe, softpipe).
bool glIsAProgram();

/// Draws runs of vertices as GL points. A GPU gets all points in one call. A rasteriser that is a
/// program (Mesa's llvmpipe) gets some points at a time, and the next ones when these are drawn:
/// such a driver keeps every undrawn primitive in host memory, some hundred bytes for a point of
/// 16, without a limit.
/// Threads  that of the GL context, current in all functions.
class DrawBatches
{
public:
  DrawBatches();
  ~DrawBatches();
  DrawBatches(const DrawBatches&) = delete;
  DrawBatches& operator=(const DrawBatches&) = delete;

  /// As often as there are buffers to draw from: a batch goes on from one to the next.
  void draw(const int* firsts, const int* counts, std::size_t runs);

private:
  void drawInTurn(const int* firsts, const int* counts, std::size_t runs);
  void flush();

  bool inTurn_ = false;
  int waiting_ = 0; ///< points handed to GL since the last flush
  std::deque<void*> underWay_; ///< GLsync of batches that were handed over
};

} // namespace pointfront
