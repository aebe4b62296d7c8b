#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace pointfront::test
{

/// Changes texts a little, the same way for the same seed: a parser must read them or say why not.
class TextMutation
{
public:
  /// `words`: what the parser may stumble on.
  TextMutation(unsigned seed, std::vector<const char*> words)
    : words_(std::move(words))
    , random_(seed)
  {
  }
  std::string of(std::string text)
  {
    for (std::size_t times = 1 + below(4); times > 0 && !text.empty(); --times)
    {
      const std::size_t at = below(text.size());
      const std::size_t size = 1 + below(below(8) == 0 ? 200 : 6);
      switch (below(6))
      {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, size);
          break;
        case 2:
          text.insert(below(text.size()), text.substr(at, size));
          break;
        case 3:
          text.replace(at, size, words_[below(words_.size())]);
          break;
        case 4:
          text.insert(at, std::string(size, static_cast<char>('0' + below(10))));
          break;
        default:
          text.resize(at);
      }
    }
    return text;
  }
  std::size_t below(std::size_t most) { return random_() % most; }

private:
  std::vector<const char*> words_;
  std::mt19937 random_;
};

} // namespace pointfront::test
