#include <folk/games/error.h>
#include <folk/games/noise.h>

#include <fmt/format.h>

namespace folk {

Noise::Noise(double probability)
    : probability_(probability) {
  if (!(probability >= 0 && probability <= 1))
    throw UsageError(fmt::format("noise {}: expected a number from 0 to 1", probability));
}

}  // namespace folk
