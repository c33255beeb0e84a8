#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/rotary_table/anglewise_covariance.h"

namespace gumcert::reports {

/// What a covariance file holds.
enum class CovarianceForm {
    automatic,  ///< CSV up to k_most_quantities_as_csv quantities, beyond that the parts
    none,       ///< no file
    csv,        ///< all elements as text, under a line of names
    npy,        ///< all elements as a NumPy file
    parts,      ///< a NumPy file whose size grows with the angles: H, L and the blocks O of V = H Lᵀ + L Hᵀ + O
};

/// A CSV of so many quantities has some 20 MB, and grows with their square.
constexpr std::size_t k_most_quantities_as_csv = 1000;

/// The form that `automatic` stands for; others stay.
[[nodiscard]] CovarianceForm chosen_form(CovarianceForm asked, std::size_t quantities);
/// "auto", "none", "csv", "npy", "parts"; nothing for another word.
[[nodiscard]] std::optional<CovarianceForm> covariance_form(std::string_view word);
/// How the name of such a file ends: ".csv", ".npy", "-parts.npy".
[[nodiscard]] std::string covariance_ending(CovarianceForm form);
/// The form of a file by its name.
[[nodiscard]] CovarianceForm form_of_file(std::string_view name);

/// Contents of a covariance file.
///
/// A file of parts has m rows and 2 r + q columns: H, L and O, in which the row of a quantity of an angle holds its
/// covariances with the q quantities of that angle, and is zero for quantities of no angle.
/// \param names  of the quantities
/// \param units  SI value of the unit of each quantity; elements are in the products of their units
/// \param form   csv, npy or parts
[[nodiscard]] std::string covariance_contents(const engine::AnglewiseCovariance& covariance,
                                              const std::vector<std::string>& names, const std::vector<double>& units,
                                              CovarianceForm form);

}  // namespace gumcert::reports
