#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/csv_table.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// The keys that say something of one quantity, and where each stands: in the job, or in a point of a table on top of
/// the job. Documents, tables and lists of problems must outlive it.
class StatementKeys {
public:
    /// The members of an object with known keys; others are passed over (the caller has refused them).
    StatementKeys(const JsonDocument& document, const std::string& pointer, std::span<const std::string_view> keys,
                  ProblemList& problems);

    /// The same with the keys of an object in place of its own.
    [[nodiscard]] StatementKeys with(const StatementKeys& other) const;
    /// The same with one number, which stands in the document or in a cell of a table.
    [[nodiscard]] StatementKeys with(std::string_view key, double number, const JsonDocument& document,
                                     const std::string& pointer, ProblemList& problems) const;
    /// \param column  its name
    [[nodiscard]] StatementKeys with(std::string_view key, double number, const CsvTable& table, const CsvCell& cell,
                                     ProblemList& problems, const std::string& column) const;

    /// The same with several numbers of a row, the first of which stands in the cell.
    /// \param decimals  the most with which one of them is written
    [[nodiscard]] StatementKeys with(std::string_view key, const std::vector<double>& numbers, int decimals,
                                     const CsvTable& table, const CsvCell& cell, ProblemList& problems,
                                     const std::string& column) const;

    /// The same without some keys.
    [[nodiscard]] StatementKeys without(std::span<const std::string_view> keys) const;

    [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
    /// Null pointer when the key is absent, or its number was refused while the text was read.
    [[nodiscard]] const nlohmann::json* value(std::string_view key) const;
    [[nodiscard]] std::vector<std::string_view> present() const;
    [[nodiscard]] std::string where() const;
    [[nodiscard]] std::string where(std::string_view key) const;
    /// Where messages go that concern the whole, from now on.
    void stands_at(const JsonDocument& document, const std::string& pointer, ProblemList& problems);
    void stands_at(const CsvTable& table, const CsvCell& cell, ProblemList& problems, const std::string& column = {});

    [[nodiscard]] std::optional<double> number(std::string_view key, const NumberRange& range) const;
    [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
    [[nodiscard]] std::optional<std::string> name(std::string_view key) const;
    [[nodiscard]] std::optional<bool> boolean(std::string_view key) const;
    /// Degrees of freedom: a number above 0 or "inf".
    [[nodiscard]] std::optional<double> degrees_of_freedom(std::string_view key) const;
    [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key) const;
    /// The most decimals with which one of the numbers under a key is written, in the document or in a table.
    [[nodiscard]] int decimals_as_written(std::string_view key) const;
    /// An object or an array of the document under a key; refused when it is something else.
    [[nodiscard]] std::optional<JsonObject> object(std::string_view key, std::span<const std::string_view> keys) const;
    [[nodiscard]] const nlohmann::json* array(std::string_view key) const;
    /// The document that has a key; the key must be in one.
    [[nodiscard]] const JsonDocument& document(std::string_view key) const { return *find(key)->origin->document; }
    [[nodiscard]] std::string pointer(std::string_view key) const;
    /// The list that problems of a key go to.
    [[nodiscard]] ProblemList& problems(std::string_view key) const;

    void refuse(const InputCode& code, std::string_view key, std::string what, std::string rule,
                std::string action) const;
    void refuse(const InputCode& code, std::string what, std::string rule, std::string action) const;
    void warn(const InputCode& code, std::string_view key, std::string what, std::string rule,
              std::string action) const;

private:
    struct Origin {
        const JsonDocument* document = nullptr;
        std::string pointer;  ///< of the object
        const CsvTable* table = nullptr;
        CsvCell cell;
        ProblemList* problems = nullptr;
        std::string column;  ///< of the table, for problems that many rows share
    };
    struct Entry {
        std::string_view key;
        std::shared_ptr<const nlohmann::json> value;  ///< owned only where it comes from a table
        std::shared_ptr<const Origin> origin;
        bool is_member = true;  ///< of the object at the origin's pointer; else the value itself stands there
        int decimals = 0;       ///< of numbers of a table, as they are written
    };
    [[nodiscard]] const Entry* find(std::string_view key) const;
    [[nodiscard]] static std::string where_of(const Entry& entry);
    /// What many rows or points may have in common: the column, or the key of a point.
    [[nodiscard]] static std::string group_of(const Origin& origin, std::string_view key);
    void put(Entry entry);
    void refuse_type(const Entry& entry, std::string_view expected) const;

    std::vector<Entry> entries_;
    std::shared_ptr<const Origin> origin_;
};

}  // namespace gumcert::jobs
