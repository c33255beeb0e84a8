#include "gum/rotary_table/studies/plan_texts.h"

#include <cmath>

#include "gum/rounding.h"
#include "text/numbers.h"

namespace gumcert::gum::plan {

namespace {

std::string mm_text(double value) {
    return round_to_quantum(value / k_mm.si, 1);
}

}  // namespace

std::string U_text(double U, const DocumentUnit& unit) {
    return U > 0.0 ? round_to_uncertainty(0.0, U / unit.si, 2, RoundingMode::up).U : "0";
}

std::string plain(double value) {
    return text::without_trailing_zeros(round_significant(value, 9));
}

std::string ratio_text(double ratio) {
    return std::isfinite(ratio) ? round_significant(ratio, 3) : "not determined";
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::vector<std::string> coordinates(const Eigen::Vector3d& position) {
    return {mm_text(position[0]), mm_text(position[1]), mm_text(position[2])};
}

std::string place_text(const Eigen::Vector3d& position) {
    const auto texts = coordinates(position);
    return texts[0] + ", " + texts[1] + ", " + texts[2];
}

}  // namespace gumcert::gum::plan
