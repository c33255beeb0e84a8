#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "certificate/certified_results.h"
#include "certificate/gates/held_against.h"
#include "reports/record/make/certificate/certify.h"

namespace gumcert::reports {

/// One value of a table, as the scope sees it.
struct ScopePlace {
    const std::vector<certificate::CertifiedTable>& tables;  ///< all of the certificate
    const certificate::CertifiedTable& table;
    const certificate::CertifiedColumn& column;
    std::size_t row = 0;
    std::size_t point = 0;               ///< position of the row among the points of the job
    double coverage_probability = 0.95;  ///< of its expanded uncertainty
    std::string range = {};              ///< what the column "range" of the points has, "10 V"; "": nothing
    std::string result = {};             ///< Result::name; "": none
    /// What a range or a capability of "value" is held against, in place of what the table says was measured.
    std::optional<certificate::HeldAgainst> assumed = {};
};

/// What the scope of accreditation says of one value.
struct ScopeAnswer {
    std::string entry;                 ///< id; "": outside
    std::string outside_because;       ///< English; "" where it is inside
    std::optional<double> capability;  ///< in the unit of the column, at the coverage probability of the result
    double outside_by = 0.0;           ///< where a range was left, by which share of its farther end; else 0
};

/// Looks a value up: name, method, place, ranges, capability. Where several lines of the scope cover it, the one with
/// the largest capability holds, so that U is below none of them. Where one line ends and the next one begins at the value,
/// both above 0 (1 V to 10 V, 10 V to 1000 V), it belongs to the line that ends there: scopes are read as if the next one
/// began above it. The points of a capability are such a range as well. A point that states a range beyond the value (`range`) belongs to the line that begins there.
///
/// A capability in a ratio (%, ppm) is one of the quantity itself: of the first argument of capability or ranges that is of
/// the kind of the result, else of the place where the result was measured. Where what was measured is larger than the
/// argument, and not of its nominal value, it is a share of this. Of a result that is less than a tenth of what an input of its
/// kind makes of it, and whose role does not say that it is the quantity itself, nobody can say that it is no error: it is
/// outside.
///
/// A capability states about 95 %. Where a result has another coverage probability (by more than 0.01), the capability
/// is carried over as normal, k_p of the result over k_p of the capability.
[[nodiscard]] ScopeAnswer scope_of(const certificate::CertificateData& data, const ScopePlace& place,
                                   const certificate::CapabilityInputs& inputs);

/// Whether the job says by its role that a result is an error, a deviation or a correction.
[[nodiscard]] bool is_difference_by_role(const ScopePlace& place);

/// An input of the kind of a result that may be what the result is an error of.
///
/// A result whose role says nothing, or says that it is an error without a place beside it, and that is less than half of
/// what an input of its kind makes of it, is a small difference of larger quantities: an error of them, or a quantity by
/// itself. Nobody can say at which value its capability is taken.
/// \return  the largest of such inputs, in its unit; nothing where the job says what the result is
[[nodiscard]] std::optional<certificate::HeldAgainst> doubtful_place(const ScopePlace& place,
                                                                     const certificate::CapabilityInputs& inputs);

}  // namespace gumcert::reports
