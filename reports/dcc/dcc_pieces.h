#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// A piece of a set that a certificate is about: a gauge block, a weight. The points of a job name it in a column of
/// certificate::k_piece_roles.
struct SetPiece {
    std::string id;                             ///< of its element: "item_1_3"
    std::string item;                           ///< id of the set
    std::string serial_number, identification;  ///< as the points state them; at least one of them
    struct Nominal {
        certificate::LocalisedText heading;  ///< of the column; empty: that of the role
        std::string unit, printed_unit;
        std::string printed;
    };
    std::optional<Nominal> nominal;  ///< the value that all of its points have in a column of the role "nominal"
};

/// The pieces of all sets of a record, in the order of its points. Points that say the same of themselves are about one piece.
class SetPieces {
public:
    SetPieces() = default;
    /// \param item_of_section  id of the item that a section is about; called with "" for a record without sections
    SetPieces(const EvaluationRecord& record, const std::function<std::string(const std::string&)>& item_of_section);

    [[nodiscard]] std::vector<SetPiece> of_item(const std::string& item) const;
    /// Ids of the items that the points of a table are about, one a row: a piece, or the set where a point names none.
    /// Empty where no point names a piece.
    [[nodiscard]] std::vector<std::string> of_rows(const std::vector<std::string>& points) const;

private:
    std::vector<SetPiece> pieces_;
    std::map<std::string, std::string> of_point_;  ///< id by the name of the point: of the piece, or of the set
    std::set<std::string> points_of_pieces_;
};

}  // namespace gumcert::reports
