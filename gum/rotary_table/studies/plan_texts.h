#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

#include "gum/rotary_table/document_units.h"

/// Numbers as the documents of `gumcert plan` print them.
namespace gumcert::gum::plan {

/// Rounded up, so that a printed U that is within a target is so (JCGM 100:2008, 7.2.6).
[[nodiscard]] std::string U_text(double U, const DocumentUnit& unit);
/// A stated number without the last digits of its conversion: 0.3, not 0.30000000000000004.
[[nodiscard]] std::string plain(double value);
[[nodiscard]] std::string ratio_text(double ratio);
/// "1 station", "6 stations".
[[nodiscard]] std::string counted(std::size_t count, const std::string& what);
/// x, y and z of a position, each in millimetres.
[[nodiscard]] std::vector<std::string> coordinates(const Eigen::Vector3d& position);
/// The same in one text, for lists.
[[nodiscard]] std::string place_text(const Eigen::Vector3d& position);

}  // namespace gumcert::gum::plan
