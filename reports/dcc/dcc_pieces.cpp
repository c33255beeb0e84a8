#include "reports/dcc/dcc_pieces.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace gumcert::reports {

namespace {

using certificate::PointColumn;

const PointColumn* column_of_role(const certificate::PointTable& points, const char* role, std::size_t row) {
    const auto found = std::find_if(points.columns.begin(), points.columns.end(), [&](const PointColumn& c) {
        return c.role == role && row < c.printed.size() && !c.printed[row].empty();
    });
    return found == points.columns.end() ? nullptr : &*found;
}

std::string word_of_role(const certificate::PointTable& points, const char* role, std::size_t row) {
    const PointColumn* const column = column_of_role(points, role, row);
    return column == nullptr ? "" : column->printed[row];
}

std::optional<SetPiece::Nominal> nominal_of(const certificate::PointTable& points, std::size_t row) {
    const PointColumn* const column = column_of_role(points, "nominal", row);
    if (column == nullptr || !column->values[row]) {
        return std::nullopt;
    }
    return SetPiece::Nominal{.heading = column->heading,
                             .unit = column->unit.empty() ? "1" : column->unit,
                             .printed_unit = column->printed_unit,
                             .printed = column->printed[row]};
}

bool is_same(const std::optional<SetPiece::Nominal>& a, const std::optional<SetPiece::Nominal>& b) {
    return a && b && a->printed == b->printed && a->unit == b->unit;
}

}  // namespace

SetPieces::SetPieces(const EvaluationRecord& record,
                     const std::function<std::string(const std::string&)>& item_of_section) {
    if (!record.points) {
        return;
    }
    const certificate::PointTable& points = *record.points;
    std::map<std::string, std::size_t> pieces_of_item;
    std::map<std::tuple<std::string, std::string, std::string>, std::size_t> position;  // item and numbers of a piece
    const auto read = [&](const std::string& section, std::size_t first, std::size_t end) {
        const std::string item = item_of_section(section);
        for (std::size_t row = first; row < std::min(end, points.points.size()); ++row) {
            SetPiece piece{.id = {},
                           .item = item,
                           .serial_number = word_of_role(points, "serial_number", row),
                           .identification = word_of_role(points, "identification", row),
                           .nominal = nominal_of(points, row)};
            // Without a number of its own a row cannot be told from another of the same nominal value: it is one more
            // point of the item.
            if (piece.serial_number.empty() && piece.identification.empty()) {
                of_point_[points.points[row]] = item;
                continue;
            }
            const auto [known, is_new] =
                position.try_emplace({item, piece.serial_number, piece.identification}, pieces_.size());
            if (is_new) {
                piece.id = item + "_" + std::to_string(++pieces_of_item[item]);
                pieces_.push_back(std::move(piece));
            } else if (!is_same(pieces_[known->second].nominal, piece.nominal)) {
                pieces_[known->second].nominal.reset();  // its points are at several values
            }
            of_point_[points.points[row]] = pieces_[known->second].id;
            points_of_pieces_.insert(points.points[row]);
        }
    };
    if (record.sections.empty()) {
        read("", 0, points.points.size());
    }
    std::size_t first = 0;
    for (const SectionSummary& section : record.sections) {
        const std::size_t end = first + static_cast<std::size_t>(section.points);
        read(section.name, first, end);
        first = end;
    }
}

std::vector<SetPiece> SetPieces::of_item(const std::string& item) const {
    std::vector<SetPiece> found;
    std::copy_if(pieces_.begin(), pieces_.end(), std::back_inserter(found),
                 [&](const SetPiece& p) { return p.item == item; });
    return found;
}

std::vector<std::string> SetPieces::of_rows(const std::vector<std::string>& points) const {
    if (std::none_of(points.begin(), points.end(),
                     [&](const std::string& p) { return points_of_pieces_.contains(p); })) {
        return {};
    }
    std::vector<std::string> ids;
    for (const std::string& point : points) {
        const auto found = of_point_.find(point);
        if (found == of_point_.end()) {
            return {};  // no point of the job
        }
        ids.push_back(found->second);
    }
    return ids;
}

}  // namespace gumcert::reports
