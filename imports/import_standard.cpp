#include "imports/import_standard.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/quantity/unit.h"
#include "json/readable_json.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/printable_text.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::imports {

namespace {

using nlohmann::ordered_json;

using reports::ImportedQuantity;

/// Where a value was measured: a number of its row of a table.
struct NominalValue {
    double value = 0.0;
    std::string unit;
    bool is_reference = false;  ///< the value of the reference, and no nominal value
};

/// Of the rows of all tables.
class NominalValues {
public:
    explicit NominalValues(const reports::ImportedCertificate& certificate) {
        for (std::size_t type = 0; type < k_types.size(); ++type) {
            for (const ImportedQuantity& q : certificate.quantities) {
                double value = 0.0;
                const char* const end = q.value.data() + q.value.size();
                if (q.table > 0 && q.row && q.role == "result" && !q.unit.empty() && has_type(q, k_types[type]) &&
                    std::from_chars(q.value.data(), end, value).ptr == end) {
                    values_[{q.table, *q.row}].push_back({&q, type, {value, q.unit, type == k_reference}});
                    if (!seen_[{q.table, q.column}].insert(value).second) {
                        repeated_.insert({q.table, q.column});
                    }
                }
            }
        }
    }

    /// The nominal value of the row, else the value of the reference; nothing where the table has neither. Where that is
    /// the same in all rows, it is what was set that tells them apart: a sensitivity measured at 100 m/s² and ten
    /// frequencies is known by the frequency. A reference that was read before the adjustment is none of a value after it.
    [[nodiscard]] std::optional<NominalValue> of(const ImportedQuantity& q) const {
        const auto row = q.row ? values_.find({q.table, *q.row}) : values_.end();
        if (row == values_.end()) {
            return std::nullopt;
        }
        const auto column_of = [](const Entry& entry) {
            return std::pair(entry.quantity->table, entry.quantity->column);
        };
        const auto begin = row->second.begin(), end = row->second.end();
        const auto is_beside = [&](const Entry& entry) {
            return entry.quantity != &q &&
                   reports::may_be_of_one_stage(q.before_adjustment, entry.quantity->before_adjustment);
        };
        const auto stated =
            std::find_if(begin, end, [&](const Entry& entry) { return is_beside(entry) && entry.type != k_set; });
        const auto set = std::find_if(begin, end, [&](const Entry& entry) {
            return is_beside(entry) && entry.type == k_set && !repeated_.contains(column_of(entry));
        });
        const bool is_known_by_it =
            stated == end || (repeated_.contains(column_of(*stated)) && seen_.at(column_of(*stated)).size() == 1);
        if (set != end && is_known_by_it) {
            return set->value;
        }
        return stated == end ? std::nullopt : std::optional(stated->value);
    }

private:
    static bool has_type(const ImportedQuantity& q, std::string_view type) {
        const std::size_t at = q.ref_type.find(type);
        const std::size_t end = at + type.size();
        return at != std::string::npos && (at == 0 || q.ref_type[at - 1] == ' ') &&
               (end == q.ref_type.size() || q.ref_type[end] == ' ');
    }

    static constexpr std::array<std::string_view, 3> k_types{"basic_nominalValue", "basic_referenceValue",
                                                             "gumcert_setting"};
    static constexpr std::size_t k_reference = 1, k_set = 2;
    struct Entry {
        const ImportedQuantity* quantity = nullptr;
        std::size_t type = 0;
        NominalValue value;
    };

    std::map<std::pair<std::size_t, std::size_t>, std::vector<Entry>> values_;  // of a table and a row
    std::map<std::pair<std::size_t, std::string>, std::set<double>> seen_;      // of a table and a column
    std::set<std::pair<std::size_t, std::string>> repeated_;                    // a column that has a value twice
};

/// A result that becomes a line.
struct StandardLine {
    std::string name;
    const ordered_json* input = nullptr;
    const ImportedQuantity* quantity = nullptr;
    std::optional<NominalValue> nominal;
};

/// How the register calls the quantities of the lines. The rows of a column are lines of one quantity, where their nominal values
/// tell them apart, and never with those of another table: a value between two ranges of an instrument is none of either.
/// Columns of several tables that have one symbol are all called by their tables.
class QuantityNames {
public:
    explicit QuantityNames(const std::vector<StandardLine>& lines) {
        std::map<Column, std::set<double>> values;
        for (const StandardLine& line : lines) {
            const Column column = column_of(*line.quantity);
            if (!line.nominal || !values[column].insert(line.nominal->value).second) {
                apart_.insert(column);
            }
            tables_[line.quantity->symbol].emplace(line.quantity->table, result_outside_of_tables(*line.quantity));
        }
    }

    /// Whether its symbol stands in several tables.
    [[nodiscard]] bool is_named_by_table(const ImportedQuantity& q) const { return tables_.at(q.symbol).size() > 1; }

    [[nodiscard]] std::string of(const StandardLine& line) {
        const ImportedQuantity& q = *line.quantity;
        const bool is_apart = apart_.contains(column_of(q));
        if (!is_apart) {
            if (const auto known = names_.find(column_of(q)); known != names_.end()) {
                return known->second;
            }
        }
        const bool is_row = q.name != q.column;
        std::string name = !is_row || is_apart ? line.name : q.column;
        if (is_named_by_table(q)) {
            name = q.result_name.empty() ? q.column : q.result_name + "_" + q.symbol;
            name += is_row && is_apart ? "_" + std::to_string(*q.row + 1) : "";
        }
        name = free_name(name);
        if (!is_apart) {
            names_.emplace(column_of(q), name);
        }
        return name;
    }

private:
    using Column = std::pair<std::size_t, std::string>;

    static Column column_of(const ImportedQuantity& q) { return {q.table, q.column}; }
    static std::string result_outside_of_tables(const ImportedQuantity& q) { return q.table > 0 ? "" : q.result; }

    std::string free_name(const std::string& name) {
        std::string free = name;
        for (int version = 2; !used_.insert(free).second; ++version) {
            free = name + "_v" + std::to_string(version);
        }
        return free;
    }

    std::set<Column> apart_;  // columns whose rows are quantities of their own
    std::map<std::string, std::set<std::pair<std::size_t, std::string>>> tables_;  // of each symbol
    std::map<Column, std::string> names_;
    std::set<std::string> used_;
};

/// A line of the register from an input of the job.
/// \param range  heading of its table, where that tells it apart; else ""
ordered_json line_of(const std::string& name, const std::string& range, const StandardLine& from) {
    const ordered_json& input = *from.input;
    ordered_json line{{"quantity", name}};
    if (!range.empty()) {
        line["range"] = range;
    }
    if (from.nominal) {
        line["nominal"] = from.nominal->value;
        if (from.nominal->unit != input.at("unit")) {
            line["nominal_unit"] = from.nominal->unit;
        }
    }
    line["value"] = input.at("value");
    line["unit"] = input.at("unit");
    if (input.contains("u")) {
        line["U"] = input["u"];
        line["k"] = 1;
    }
    for (const char* key : {"U", "k", "p", "nu"}) {
        if (input.contains(key)) {
            line[key] = input[key];
        }
    }
    return line;
}

/// Where lines have the values of a reference in place of nominal values: a use at 5 V finds no line at 5.00005 V.
void add_references(const std::vector<StandardLine>& lines, const std::string& file,
                    std::vector<gum::Diagnostic>& remarks) {
    std::vector<std::string> values;
    for (const StandardLine& line : lines) {
        if (line.nominal && line.nominal->is_reference) {
            const std::string unit = gum::unit_for_people(line.nominal->unit);
            values.push_back(text::shortest_plain(line.nominal->value) + (unit.empty() ? "" : " " + unit));
        }
    }
    if (!values.empty()) {
        remarks.push_back({.code = "GC-LAB-0023",
                           .where = file,
                           .what = "lines without a nominal value on the certificate have that of the reference: " +
                                   text::listed(values, 8),
                           .rule = "an input finds a line by its nominal value, \"at\"",
                           .action = "state in \"nominal\" at which value each of them is used",
                           .severity = gum::Severity::note});
    }
}

void set_if_there(ordered_json& object, const char* key, const std::string& text) {
    if (!text.empty()) {
        object[key] = reports::printable(text);
    }
}

}  // namespace

ImportedJob import_standard(std::string_view bytes, const std::string& file, const std::string& id,
                            const CertificateTrust& trust) {
    ImportedJob imported = import_certificate(bytes, file, trust);
    const reports::ImportedCertificate certificate = reports::read_dcc(bytes, file);
    const ordered_json job = ordered_json::parse(imported.job);
    const NominalValues nominal_values(certificate);
    std::vector<StandardLine> results;
    std::vector<std::string> before;  // an adjustment: what the standard was, and is not any more
    std::size_t position = 0;
    for (const auto& [name, input] : job.at("inputs").items()) {
        const ImportedQuantity& q = certificate.quantities.at(imported.quantities.at(position++));
        if (input.contains("constant")) {
            continue;
        }
        if (q.before_adjustment == true) {
            before.push_back(name);
            continue;
        }
        results.push_back({.name = name, .input = &input, .quantity = &q, .nominal = nominal_values.of(q)});
    }
    QuantityNames names(results);
    ordered_json lines = ordered_json::array();
    for (const StandardLine& result : results) {
        const ImportedQuantity& q = *result.quantity;
        constexpr std::size_t k_longest_range = 60;  // [character]: a line of the register has 256 bytes
        lines.push_back(
            line_of(names.of(result),
                    names.is_named_by_table(q) ? reports::shortened(reports::printable(q.result), k_longest_range) : "",
                    result));
    }
    if (lines.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-LAB-0021",
                                              .where = file,
                                              .what = "no result with an uncertainty",
                                              .rule = "the value of a standard has an uncertainty",
                                              .action = "write the file of the standard by hand"});
    }
    ordered_json calibration = ordered_json::object();
    set_if_there(calibration, "calibrated",
                 !certificate.performed_to.empty()     ? certificate.performed_to
                 : !certificate.performed_from.empty() ? certificate.performed_from
                                                       : certificate.issued);
    set_if_there(calibration, "certificate", certificate.identifier);
    set_if_there(calibration, "issuer", certificate.laboratory);
    calibration["sha256"] = certificate.sha256;
    calibration["results"] = std::move(lines);
    const ordered_json standard{{"schema", "gumcert/standard/1"},
                                {"id", id},
                                {"description", certificate.item.empty() ? id : reports::printable(certificate.item)},
                                {"calibrations", ordered_json::array({std::move(calibration)})}};
    imported.job = gumcert::json::readable_json(standard) + "\n";
    // Of the inputs of a job: the register holds lines of one certificate, and who uses two of them is told (GC-LAB-0109).
    std::erase_if(imported.remarks, [](const gum::Diagnostic& remark) { return remark.code == "GC-DCC-0032"; });
    add_references(results, file, imported.remarks);
    if (!before.empty()) {
        imported.remarks.push_back(
            {.code = "GC-LAB-0022",
             .where = file,
             .what = std::to_string(before.size()) + (before.size() == 1 ? " result" : " results") +
                     " before the adjustment left out: " + text::listed(before, 8),
             .rule = "the value of a standard is that after its adjustment",
             .action = "nothing; its drift is seen from the result before the adjustment and the "
                       "certificate before",
             .severity = gum::Severity::note});
    }
    imported.remarks.push_back({.code = "GC-LAB-0020",
                                .where = file,
                                .what = "a certificate does not say how the standard drifts, how long it may be used, "
                                        "and by which route it is traceable",
                                .rule = "the laboratory decides on \"drift\", \"valid_to\" and \"route\"",
                                .action = "add them: without \"drift\" the register refuses the file",
                                .severity = gum::Severity::note});
    return imported;
}

}  // namespace gumcert::imports
