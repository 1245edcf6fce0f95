// parse_curve: whatever is read is a curve that can be drawn.

#include <folk/mpe/pictures/curve_file.h>

#include <cstdint>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view bytes) {
    using namespace folk::mpe;
    const LearningCurve curve = parse_curve(bytes, "fuzz.csv", "return");
    folk::fuzz::require(curve.episodes.size() == curve.returns.size() && !curve.episodes.empty());
    learning_curve_script({"fuzz", "return", {curve}, {}}, folk::PictureFormat::svg);
  });
}
