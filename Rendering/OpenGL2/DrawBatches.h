#pragma once

#include <cstddef>
#include <deque>

namespace pointfront
{

/// Whether the GL of the current context is itself a program (GL_RENDERER llvmpipe, softpipe).
bool glIsAProgram();

/// Draws runs of vertices as GL points. On a rasteriser that is a program (Mesa's llvmpipe) it
/// hands over some at a time and goes on when those before are drawn: such a driver keeps every
/// primitive that is not drawn yet in host memory, some hundred bytes for a point of 16, and does
/// not limit how many. A GPU gets all in one call.
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
