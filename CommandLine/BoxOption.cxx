#include "BoxOption.h"

#include "Values.h"

#include <CLI/CLI.hpp>

namespace pointfront
{

void declareBox(
  CLI::App& app, const std::string& help, const std::function<void(const Bounds&)>& take)
{
  const auto box = [take](const CLI::results_t& words)
  {
    const auto numbers = parseNumbers<6>(words.back());
    if (!numbers || (*numbers)[0] > (*numbers)[3] || (*numbers)[1] > (*numbers)[4] ||
      (*numbers)[2] > (*numbers)[5])
    {
      throw CLI::ParseError("--box: '" + words.back() +
          "' is not a box: write x0,y0,z0,x1,y1,z1 with lower before upper corner",
        2);
    }
    const auto& n = *numbers;
    take(Bounds{ { n[0], n[1], n[2] }, { n[3], n[4], n[5] } });
    return true;
  };
  app.add_option("--box", box, help)->type_name("x0,y0,z0,x1,y1,z1")->expected(1);
}

} // namespace pointfront
