#include "app/certified_texts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "reports/record/reported_result.h"
#include "reports/record/stated_values.h"

namespace gumcert::app {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using reports::Printed;

/// Finds values in the tables by the names of the record.
class Tables {
public:
    explicit Tables(const std::vector<CertifiedTable>& tables) : tables_(tables) {}

    /// \param point  name of the point of a table of points; "" = the only value
    [[nodiscard]] const CertifiedValue* find(const std::string& table, const std::string& result,
                                             const std::string& point = "") const {
        for (const CertifiedTable& t : tables_) {
            const CertifiedColumn* c = t.id == table ? column(t, result) : nullptr;
            if (c == nullptr || t.argument.has_value() == point.empty()) {
                continue;
            }
            if (point.empty()) {
                return &c->values.front();
            }
            const auto& names = t.argument->printed;
            const auto at = std::find(names.begin(), names.end(), point);
            if (at != names.end()) {
                return &c->values[static_cast<std::size_t>(at - names.begin())];
            }
        }
        return nullptr;
    }
    [[nodiscard]] const CertifiedValue* at_row(const std::string& table, const std::string& result,
                                               std::size_t row) const {
        for (const CertifiedTable& t : tables_) {
            const CertifiedColumn* c = t.id == table ? column(t, result) : nullptr;
            if (c != nullptr && row < c->values.size()) {
                return &c->values[row];
            }
        }
        return nullptr;
    }

private:
    const std::vector<CertifiedTable>& tables_;

    static const CertifiedColumn* column(const CertifiedTable& table, const std::string& result) {
        const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                        [&](const CertifiedColumn& c) { return c.result == result; });
        return found == table.columns.end() ? nullptr : &*found;
    }
};

void take(Printed& text, const CertifiedValue* from) {
    if (from != nullptr) {
        text.value = from->printed_value;
        text.U = from->printed_U;
    }
}

/// What is certified is what is reported; the law of propagation has the same texts where it is reported itself.
void take(reports::Result& result, const CertifiedValue* from) {
    if (from == nullptr) {
        return;
    }
    result.reported = reports::reported_result(result);
    take(result.reported.printed, from);
    result.reported.printed_low = from->printed_low;
    result.reported.printed_high = from->printed_high;
    if (result.reported.method == "law_of_propagation") {
        take(result.printed, from);
    }
}

/// O_y → coordinate 1 of the offsets.
void take_set_up(reports::RotaryTable& rotary, const std::string& name, const CertifiedValue* from) {
    if (from == nullptr || name.size() != 3 || name[1] != '_' || name[2] < 'x' || name[2] > 'z') {
        return;
    }
    const auto coordinate = static_cast<std::size_t>(name[2] - 'x');
    const bool offset = name[0] == 'O';
    take((offset ? rotary.set_up.printed_O : rotary.set_up.printed_S)[coordinate], from);
    Printed& seen = (offset ? rotary.axis_in_fixture.printed_O : rotary.axis_in_fixture.printed_S)[coordinate];
    seen.value = reports::negated(from->printed_value);
    seen.U = from->printed_U;
}

void print_rotary(reports::RotaryTable& rotary, const Tables& tables) {
    for (const auto& place : reports::stated_values(rotary)) {
        const std::string table = reports::group_name(place.group);
        const std::string result = reports::result_name(place.group, place.name);
        const bool motion = place.group == reports::StatedGroup::error_motions;
        take(place.stated.printed, motion ? tables.at_row(table, result, place.index) : tables.find(table, result));
    }
}

}  // namespace

void print_as_certified(reports::EvaluationRecord& record, const std::vector<CertifiedTable>& all) {
    const Tables tables(all);
    const char* const table = record.rotary ? "set_up" : "results";
    for (reports::Result& result : record.results) {
        const CertifiedValue* from =
            tables.find(table, result.quantity.empty() ? result.name : result.quantity, result.point);
        take(result, from);
        if (record.rotary) {
            take_set_up(*record.rotary, result.name, from);
        }
    }
    if (record.rotary) {
        print_rotary(*record.rotary, tables);
    }
}

}  // namespace gumcert::app
