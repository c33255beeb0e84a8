#include "jobs/budget/point_file.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_statement.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/csv_table.h"
#include "jobs/input_codes.h"
#include "jobs/job_limits.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

class PointFile {
public:
    PointFile(std::string name, ProblemList& problems, LaboratoryUse& laboratory, const JsonDocument& document,
              const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits, BudgetPoints& points)
        : name_(std::move(name)),
          problems_(problems),
          laboratory_(laboratory),
          document_(document),
          inputs_(inputs),
          fits_(fits),
          points_(points) {}

    void read(std::string bytes) {
        read_columns(bytes);
        for (const Column& column : columns_) {
            if (column.input) {
                points_.use(*column.input);  // as in a list: every row states it
            }
        }
        choose_standards();
        std::vector<std::string_view> wanted;
        for (const Column& column : columns_) {
            wanted.emplace_back(column.name);
        }
        const auto table = read_csv_table(std::move(bytes), wanted, {}, problems_, {.rows = k_most_points});
        if (!table || !is_known_) {
            return;
        }
        laboratory_.fill_rows(document_, *table, wanted, problems_);
        check_notations(*table);
        for (std::size_t row = 0; row < table->rows(); ++row) {
            read_row(*table, row);
        }
    }

private:
    struct Column {
        std::string name;
        std::optional<std::size_t> input = {};  ///< in BudgetInputs::stated()
        std::string_view key = {};
        std::optional<std::size_t> for_people = {};  ///< in the columns of the points
        bool is_reading = false;
        bool is_reference = false;    ///< to a standard of the laboratory: NAME.standard, NAME.at …
        bool takes_standard = false;  ///< of these, the one that stands for all of its input
    };
    /// Readings of one input in a row.
    struct Readings {
        std::vector<double> numbers;
        std::size_t first = 0;  ///< column of the first of them
        int decimals = 0;
    };

    // ---- columns ----------------------------------------------------------------------------------------------------

    void read_columns(std::string_view bytes) {
        std::vector<std::string> seen;
        for (const CsvHeaderField& field : csv_header(bytes)) {
            if (std::find(seen.begin(), seen.end(), field.name) != seen.end() || seen.size() > k_most_inputs) {
                continue;  // refused when the table is read
            }
            seen.push_back(field.name);
            if (field.name == k_point_name) {
                name_column_ = columns_.size();
                columns_.push_back({.name = field.name});
            } else if (const auto own = points_.columns().find(field.name)) {
                columns_.push_back({.name = field.name, .for_people = own});
            } else {
                const std::string where = text::where_in_text(name_, field.place);
                if (!refused_for_unit(field.name, where)) {
                    read_column_of_input(field.name, where);
                }
            }
        }
    }

    /// Refuses "V_x [mV]" and "V_x.u (mV)". Of another name the brackets hold words for people: "Remark (free)".
    [[nodiscard]] bool refused_for_unit(const std::string& head, const std::string& where) {
        const std::size_t bracket = head.find_first_of("[(");
        if (bracket == std::string::npos || bracket == 0) {
            return false;
        }
        std::string bare = head.substr(0, bracket);
        bare.erase(bare.find_last_not_of(' ') + 1);
        if (!inputs_.is_named(bare.substr(0, bare.rfind('.')))) {
            return false;
        }
        problems_.refuse(k_unknown_key, where, "the column " + text::in_quotes(head),
                         "a column is called NAME or NAME.key: its unit is that of the input",
                         "write " + text::in_quotes(bare) + ", and state the unit in the job");
        is_known_ = false;
        return true;
    }

    void read_column_of_input(const std::string& head, const std::string& where) {
        const std::size_t dot = head.rfind('.');
        const bool is_reading = dot != std::string::npos && dot + 1 < head.size() &&
                                head.find_first_not_of("0123456789", dot + 1) == std::string::npos;
        if (is_reading) {
            columns_.push_back({.name = head,
                                .input = input_of(head.substr(0, dot), where, head),
                                .key = "observations",
                                .is_reading = true});
            return;
        }
        if (const auto [of_input, word] = LaboratoryUse::reference_column(head); !word.empty()) {
            columns_.push_back({.name = head,
                                .input = input_of(std::string(of_input), where, head),
                                .key = word,
                                .is_reference = true});
            return;
        }
        const std::span<const std::string_view> keys = budget_column_keys();
        const std::string_view key =
            dot == std::string::npos ? std::string_view{"value"} : std::string_view{head}.substr(dot + 1);
        const auto known = std::find(keys.begin(), keys.end(), key);
        const auto input = input_of(head.substr(0, dot), where, head);
        if (input && known == keys.end()) {
            const auto nearest = nearest_word(key, keys);
            problems_.refuse(k_unknown_key, where,
                             "the key " + text::in_quotes(key) + " of the column " + text::in_quotes(head),
                             "the keys of a column are " + text::any_of(keys) + ", and of a standard " +
                                 text::any_of(LaboratoryUse::reference_keys()),
                             nearest ? "did you mean " + text::in_quotes(*nearest) + "?" : "remove the column");
            is_known_ = false;
        } else if (input) {
            columns_.push_back({.name = head, .input = input, .key = *known});
        }
    }

    [[nodiscard]] std::optional<std::size_t> input_of(const std::string& name, const std::string& where,
                                                      const std::string& head) {
        const auto input = input_of_point(name, where, inputs_, fits_, problems_, &head);
        is_known_ = is_known_ && input;
        return input;
    }

    /// Of the columns that say how a standard is used, one stands for all: that which names it, or the first where the
    /// input names it.
    void choose_standards() {
        const auto is_of_standard = [&](const Column& column, std::size_t input) {
            return column.is_reference && column.input == input;
        };
        for (Column& column : columns_) {
            if (!column.is_reference || !column.input) {
                continue;
            }
            const bool names_standard = std::any_of(columns_.begin(), columns_.end(), [&](const Column& other) {
                return is_of_standard(other, *column.input) && other.key == "standard";
            });
            if (names_standard) {
                column.takes_standard = column.key == "standard";
            } else if (laboratory_.is_stated_once(inputs_.stated()[*column.input].name)) {
                column.takes_standard = std::none_of(columns_.begin(), columns_.end(), [&](const Column& other) {
                    return is_of_standard(other, *column.input) && other.takes_standard;
                });
            } else {
                const std::string standard = column.name.substr(0, column.name.rfind('.')) + ".standard";
                problems_.refuse(k_unknown_key, name_ + ":1",
                                 "the column " + text::in_quotes(column.name) + " without " + text::in_quotes(standard),
                                 "it says how a standard is used, and the input or the row names the standard itself",
                                 "name the standard in the input, or add the column " + text::in_quotes(standard));
                is_known_ = false;
            }
        }
    }

    void check_notations(const CsvTable& table) {
        std::map<std::size_t, AngleNotation> notations;  // of inputs, whose readings have a column each
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const Column& column = columns_[c];
            if (column.input && (column.key == "value" || column.is_reading)) {
                notations[*column.input].see(table, c);
            } else if (column.for_people && !points_.columns().has_words(*column.for_people)) {
                AngleNotation of_column;
                of_column.see(table, c);
                of_column.refuse_mixture("column " + text::visible(column.name), problems_);
            }
        }
        for (const auto& [input, notation] : notations) {
            notation.refuse_mixture("column " + text::visible(inputs_.stated()[input].name), problems_);
        }
    }

    // ---- rows -------------------------------------------------------------------------------------------------------

    void read_row(const CsvTable& table, std::size_t row) {
        StatedPoint stated;
        std::map<std::size_t, Readings> readings;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const Column& column = columns_[c];
            if (column.for_people) {
                points_.columns().read_cell(*column.for_people, table, row, c, problems_);
            } else if (!column.input) {
                const auto text = table.name(row, c);
                stated.name = text ? std::optional{std::string{*text}} : std::nullopt;
            } else if (!column.is_reference || column.takes_standard) {  // others are read with the standard
                read_cell(table, row, c, stated, readings);
            }
        }
        for (const auto& [input, read] : readings) {
            stated.replace(input, "observations",
                           stated.keys_of_input(input, inputs_)
                               .with("observations", read.numbers, read.decimals, table, table.cell(row, read.first),
                                     problems_, columns_[read.first].name));
            stated.decimals[input] = read.decimals + (read.numbers.size() > 1 ? 1 : 0);
        }
        const std::string where = columns_.empty() ? "" : table.where(table.cell(row, name_column_.value_or(0)));
        points_.add(stated, where, problems_);
    }

    void read_cell(const CsvTable& table, std::size_t row, std::size_t c, StatedPoint& stated,
                   std::map<std::size_t, Readings>& readings) {
        const Column& column = columns_[c];
        const std::size_t input = *column.input;
        const CsvCell& cell = table.cell(row, c);
        if (cell.text.empty() && (!column.is_reference || column.key == "standard")) {
            problems_.refuse(
                k_empty_cell, table.where(cell),
                "row " + std::to_string(row + 1) + " has no value in the column " + text::in_quotes(column.name),
                "a missing value is neither 0 nor that of another row",
                "state it; leave the column out where all points take what the job states", "empty " + column.name);
            stated.refused.insert(input);
        } else if (column.is_reference) {
            read_standard(row, input, stated);
        } else {
            read_number(table, row, c, stated, readings);
        }
    }

    void read_standard(std::size_t row, std::size_t input, StatedPoint& stated) {
        const LaboratoryUse::Row of_standard = laboratory_.row(row, inputs_.stated()[input].name);
        if (of_standard.document == nullptr) {
            stated.refused.insert(input);
            return;
        }
        const StatementKeys own(*of_standard.document, of_standard.pointer, keys_of<OverrideStatement>(), problems_);
        stated.replace(input, "components", stated.keys_of_input(input, inputs_).with(own));
    }

    void read_number(const CsvTable& table, std::size_t row, std::size_t c, StatedPoint& stated,
                     std::map<std::size_t, Readings>& readings) {
        const Column& column = columns_[c];
        const std::size_t input = *column.input;
        const bool may_be_angle = column.key == "value" || column.is_reading;
        const auto read = number_in_cell(table, row, c, may_be_angle ? inputs_.stated()[input].unit.text() : "",
                                         column.name, problems_);
        if (!read) {
            stated.refused.insert(input);
            return;
        }
        const int decimals = text::most_decimals({&read->written, 1});
        if (column.is_reading) {
            Readings& of_input = readings[input];
            of_input.first = of_input.numbers.empty() ? c : of_input.first;
            of_input.numbers.push_back(read->value);
            of_input.decimals = std::max(of_input.decimals, decimals);
            return;
        }
        if (column.key == "value") {
            stated.decimals[input] = decimals;
        }
        stated.replace(input, column.key,
                       stated.keys_of_input(input, inputs_)
                           .with(column.key, read->value, table, table.cell(row, c), problems_, column.name));
    }

    std::string name_;
    ProblemList& problems_;  ///< of the file
    LaboratoryUse& laboratory_;
    const JsonDocument& document_;
    const BudgetInputs& inputs_;
    const std::vector<gum::BudgetFit>& fits_;
    BudgetPoints& points_;
    std::vector<Column> columns_;
    std::optional<std::size_t> name_column_;
    bool is_known_ = true;  ///< what every column is
};

}  // namespace

void read_point_file(const std::string& name, JobFiles& files, LaboratoryUse& laboratory, const JsonDocument& document,
                     const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits, BudgetPoints& points) {
    if (std::optional<JobFiles::File> file = files.open(name)) {
        PointFile(name, *file->problems, laboratory, document, inputs, fits, points).read(std::move(file->bytes));
    }
}

}  // namespace gumcert::jobs
