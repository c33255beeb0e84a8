#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"
#include "json/json_pointer.h"
#include "json/step.h"
#include "json/strict_parser.h"
#include "json/struct_reader.h"
#include "reports/record/record_check.h"
#include "reports/record/record_fields.h"
#include "reports/record/record_kinds.h"
#include "reports/record/record_problems.h"
#include "reports/record/record_rules.h"
#include "reports/record/record_value.h"
#include "reports/record/reported_result.h"
#include "text/file_guess.h"

namespace gumcert::reports {

namespace {

using gumcert::json::canonical_json;
using gumcert::json::Fault;
using gumcert::json::Step;
using nlohmann::json;
using Range = certificate::NumberRule;

/// A record is limited as a whole, and holds whole files. Its own rules tell of long integers, with their places.
constexpr gumcert::json::ParserOptions k_record_text{
    .string_bytes = k_max_record_bytes, .values = k_max_record_bytes, .byte_order_mark = true, .long_integers = true};

class Reader : public gumcert::json::StructReader<Reader, Step> {
public:
    /// \param place  its steps above and their keys outlive the reader
    Reader(const json& object, const Step& place, RecordProblems& problems)
        : StructReader(object, place), problems_(problems) {}

    template <class Words>
    void unknown_word(const Step& at, const std::string& word, const Words& allowed) {
        std::string rule = "must be one of";
        for (const std::string_view name : allowed) {
            rule += " \"" + std::string(name) + '"';
        }
        problems_.add("GC-RECORD-0016", at.pointer(), '"' + word + '"', rule, k_restore);
    }

    using StructReader::operator();

    template <class Number, class Rule = gumcert::json::NoRule>
    void operator()(const char* key, Shown<Number>& v, const Rule& rule = {}) {
        shown(key, key, v, rule);
    }

    template <class Number, class Rule = gumcert::json::NoRule>
    void shown(const char* key, const char* text_key, Shown<Number>& v, const Rule& rule = {}) {
        (*this)(key, v.number, rule);
        text(text_key, v.text);
    }

    /// A text of the object `printed`, which finish() reads as a whole.
    template <class Text>
    void text(const char* key, Text& v) {
        texts_.push_back([key, &v](Reader& printed) { printed(key, v); });
    }
    template <class Text>
    void text_added(const char* key, Text& v) {
        texts_.push_back([key, &v](Reader& printed) { printed.added(key, v); });
    }

    /// A number whose text a later release added.
    template <class Number, class Rule = gumcert::json::NoRule>
    void text_added(const char* key, Shown<Number>& v, const Rule& rule = {}) {
        (*this)(key, v.number, rule);
        text_added(key, v.text);
    }

    template <class Type>
    void filled(const char* key, Type& v) {
        (*this)(key, v);
    }
    template <class Type>
    void filled_if_any(const char* key, Type& v) {
        stated(key, v);
    }

    template <class Enumerator>
    void named(const char* key, Enumerator& v, std::initializer_list<const char*> words) {
        std::string name;
        (*this)(key, name, words);
        const auto found = std::find(words.begin(), words.end(), name);
        if (found != words.end()) {
            v = static_cast<Enumerator>(found - words.begin());
        }
    }

    /// A key that a later release added to the schema: where it is missing, the value stays as it is.
    template <class Type, class... Rule>
    void added(const char* key, Type& v, const Rule&... rule) {
        if (object_.contains(key)) {
            (*this)(key, v, rule...);
        }
    }
    void added(const char* key, std::string& v, std::initializer_list<const char*> allowed) {
        if (object_.contains(key)) {
            (*this)(key, v, allowed);
        }
    }

    template <class Number, class... Rule>
    void added(const char* key, Shown<Number>& v, const Rule&... rule) {
        added(key, v.number, rule...);
        text_added(key, v.text);
    }

    template <class Describe>
    void group(const char* key, const Describe& describe_group) {
        if (const json* item = find(key)) {
            const Step at = place_.child(key);
            if (!item->is_object()) {
                wrong_type(*item, "an object", at);
                return;
            }
            Reader inner(*item, at, problems_);
            describe_group(inner);
            inner.finish();
        }
    }

    /// To be called when every key was asked for.
    void finish() {
        if (!texts_.empty()) {
            group("printed", [&](Reader& printed) {
                for (const auto& read_text : texts_) {
                    read_text(printed);
                }
            });
        }
        StructReader::finish();
    }

    void constant(const char* key, const char*) { static_cast<void>(find(key)); }  // the caller has looked at it

    /// Records of earlier releases state none.
    void digest(const char* key, std::string& value) {
        const json* item = find_if_there(key);
        if (item == nullptr) {
            return;
        }
        const Step at = place_.child(key);
        if (!item->is_object()) {
            wrong_type(*item, "an object", at);
            return;
        }
        std::string algorithm;
        Reader inner(*item, at, problems_);
        inner("algorithm", algorithm, {k_digest_algorithm});
        inner("value", value);
        inner.finish();
        if (value.empty()) {
            problems_.add("GC-RECORD-0016", at.pointer() + "/value", "\"\"", "must be 64 hexadecimal digits",
                          k_restore);
        }
    }

    void severity(const char* key, gum::Severity& v) {
        std::string name;
        (*this)(key, name, {k_severities[0], k_severities[1], k_severities[2]});
        for (std::size_t i = 0; i < k_severities.size(); ++i) {
            if (name == k_severities[i]) {
                v = static_cast<gum::Severity>(i);
            }
        }
    }

    void document(const char* key, std::string& text) {
        if (const json* item = find(key)) {
            text = canonical_json(*item);
        }
    }

    /// The text of an object; "" for null.
    void object_or_null(const char* key, std::string& text) {
        const json* item = find(key);
        if (item != nullptr && item->is_object()) {
            text = canonical_json(*item);
        } else if (item != nullptr && !item->is_null()) {
            wrong_type(*item, "an object or null", place_.child(key));
        }
    }

    void results(const char* key, std::vector<Result>& v) {
        const json* all = find_object(key);
        if (all == nullptr) {
            return;
        }
        const Step all_at = place_.child(key);
        std::map<std::int64_t, Result> in_order;
        for (const auto& [name, item] : all->items()) {
            const Step at = all_at.child(name);
            if (!item.is_object()) {
                wrong_type(item, "an object", at);
                continue;
            }
            Result result;
            result.name = name;
            std::int64_t order = -1;
            Reader inner(item, at, problems_);
            describe(inner, result);
            inner("order", order);
            inner.finish();
            result.reported = reported_result(result);
            if (order < 0 || static_cast<std::uint64_t>(order) >= all->size() || in_order.contains(order)) {
                problems_.add("GC-RECORD-0016", at.pointer() + "/order", std::to_string(order),
                              "the orders of all results are 0, 1, 2 …, each once", k_restore);
                continue;
            }
            in_order.emplace(order, std::move(result));
        }
        for (auto& [order, result] : in_order) {
            v.push_back(std::move(result));
        }
    }

    /// Records of earlier releases hold no order of the directions: then they come by name, "all" last.
    void summary(const char* key, std::vector<ComparisonSummary>& v) {
        const json* all = find_object(key);
        if (all == nullptr) {
            return;
        }
        const Step all_at = place_.child(key);
        std::map<std::int64_t, ComparisonSummary> in_order;
        const auto size = static_cast<std::int64_t>(all->size());
        const bool ordered =
            std::any_of(all->begin(), all->end(), [](const json& i) { return i.is_object() && i.contains("order"); });
        std::int64_t next = 0;
        for (const auto& [direction, item] : all->items()) {
            const Step at = all_at.child(direction);
            if (!item.is_object()) {
                wrong_type(item, "an object", at);
                continue;
            }
            ComparisonSummary s;
            s.direction = direction;
            std::int64_t order = direction == "all" ? size - 1 : next++;
            Reader inner(item, at, problems_);
            describe(inner, s);
            if (ordered) {
                order = -1;
                inner("order", order);
            }
            inner.finish();
            if (order < 0 || order >= size || in_order.contains(order)) {
                problems_.add("GC-RECORD-0016", at.pointer() + "/order", std::to_string(order),
                              "the orders of all directions are 0, 1, 2 …, each once", k_restore);
                continue;
            }
            in_order.emplace(order, std::move(s));
        }
        for (auto& [order, s] : in_order) {
            v.push_back(std::move(s));
        }
    }

    void errors(const char* key, std::vector<ErrorsAtAngle>& v, const RotaryTable& rotary) {
        for_each_row(key, [&](Reader& inner) {
            ErrorsAtAngle& row = v.emplace_back();
            inner("angle_deg", row.angle_deg.number);
            inner("printed_angle", row.angle_deg.text);
            for (std::size_t m = 0; m < row.errors.size(); ++m) {
                inner(rotary.error_names[m].c_str(), row.errors[m]);
            }
        });
    }

    void quantity_budgets(const char* key, std::vector<QuantityBudget>& v, const std::vector<std::string>& sources) {
        for_each_row(key, [&](Reader& inner) {
            QuantityBudget& row = v.emplace_back();
            inner("quantity", row.quantity);
            inner("angle_deg", row.angle_deg);
            inner("u", row.u, Range::not_negative);
            inner("unit", row.unit);
            inner.group("shares", [&](auto& shares) {
                for (const std::string& source : sources) {
                    double share = 0.0;
                    shares(source.c_str(), share);
                    row.shares.push_back(share);
                }
            });
        });
    }

    /// What is said twice has to be the same twice.
    void by_name(const std::vector<TableParameter>& v) {
        const json* U = find_object("U");
        const Step U_at = place_.child("U");
        const auto same = [&](const json* in, const Step& at, const std::string& name, double expected) {
            const auto found = in == nullptr ? json::const_iterator() : in->find(name);
            const bool stated = in != nullptr && found != in->end();
            if (in != nullptr && (!stated || !found->is_number() || found->get<double>() != expected)) {
                problems_.add("GC-RECORD-0016", at.child(name).pointer(), stated ? found->dump() : "missing",
                              "must be " + record_number(expected) + ", as the parameter of that name says", k_restore);
            }
        };
        std::set<std::string> names;
        for (const TableParameter& p : v) {
            names.insert(p.name);
            static_cast<void>(find_if_there(p.name));
            same(&object_, place_, p.name, p.stated.value);
            same(U, U_at, p.name, p.stated.U);
        }
        if (U == nullptr) {
            return;
        }
        for (const auto& [name, item] : U->items()) {
            if (!names.contains(name)) {
                problems_.add("GC-RECORD-0014", U_at.child(name).pointer(), "unknown key",
                              "U holds the parameters of the list and no others", k_restore);
            }
        }
    }

private:
    friend StructReader;
    static constexpr bool k_null_is_none = true;
    RecordProblems& problems_;
    std::vector<std::function<void(Reader&)>> texts_;  ///< of the object `printed`

    /// Calls read(reader of the object) for each object of an array; anything else in it is reported and left out.
    template <class Read>
    void for_each_row(const char* key, const Read& read) {
        const json* all = find_array(key);
        if (all == nullptr) {
            return;
        }
        const Step all_at = place_.child(key);
        for (std::size_t i = 0; i < all->size(); ++i) {
            const Step at = all_at.child(i);
            if (!(*all)[i].is_object()) {
                wrong_type((*all)[i], "an object", at);
                continue;
            }
            Reader inner((*all)[i], at, problems_);
            read(inner);
            inner.finish();
        }
    }

    const json* find(std::string_view key) {
        const json* item = find_if_there(key);
        if (item == nullptr) {
            problems_.add("GC-RECORD-0013", place_.child(key).pointer(), "missing",
                          "every key of schema gumcert/record/1 is present", k_restore);
        }
        return item;
    }

    void require(std::string_view) {}  // find() has

    void unknown_key(const std::string& key) {
        problems_.add("GC-RECORD-0014", place_.child(key).pointer(), "unknown key",
                      "a record holds the keys of schema gumcert/record/1 and no others", k_restore);
    }

    const json* find_object(const char* key) {
        const json* item = find(key);
        if (item != nullptr && !item->is_object()) {
            wrong_type(*item, "an object", place_.child(key));
            return nullptr;
        }
        return item;
    }

    const json* find_array(const char* key) {
        const json* item = find(key);
        if (item != nullptr && !item->is_array()) {
            wrong_type(*item, "an array", place_.child(key));
            return nullptr;
        }
        return item;
    }

    void wrong_type(const json& item, const std::string& expected, const Step& at) {
        problems_.add("GC-RECORD-0015", at.pointer(), item.type_name(), "must be " + expected, k_restore);
    }

    void wrong_size(const json& item, std::size_t size, const Step& at) {
        problems_.add("GC-RECORD-0017", at.pointer(), std::to_string(item.size()) + " items",
                      "must be " + std::to_string(size), k_restore);
    }

    template <class Struct>
    void read_struct(const json& object, Struct& v, const Step& at) {
        Reader inner(object, at, problems_);
        describe(inner, v);
        inner.finish();
    }

    template <class Rule>
    void read_value(const json& item, certificate::LocalisedText& v, const Step& at, const Rule&) {
        if (item.is_string()) {
            v.plain = item.get<std::string>();
            return;
        }
        if (!item.is_object()) {
            wrong_type(item, "a text, or an object with one text a language", at);
            return;
        }
        Reader inner(item, at, problems_);
        for (const std::string_view language : certificate::k_languages) {
            if (const std::string key(language); item.contains(key)) {
                std::string text;
                inner(key.c_str(), text);
                v.by_language.emplace_back(key, std::move(text));
            }
        }
        inner.finish();
        if (item.empty()) {
            problems_.add("GC-RECORD-0016", at.pointer(), "no language", "a text is stated in one language at least",
                          k_restore);
        }
    }

    template <class Rule>
    static Range range_of(const Rule& rule) {
        if constexpr (std::same_as<Rule, Range>) {
            return rule;
        } else {
            return Range::any;
        }
    }

    template <class Rule>
    void read_value(const json& item, double& v, const Step& at, const Rule& rule) {
        if (!item.is_number()) {
            wrong_type(item, "a number", at);
            return;
        }
        v = item.get<double>();
        const Range range = range_of(rule);
        // Whole numbers above 2^53 that a double cannot hold would lose digits in silence.
        constexpr double k_two_to_53 = 9007199254740992.0;
        if (!item.is_number_float() && std::abs(v) > k_two_to_53) {
            problems_.add("GC-RECORD-0016", at.pointer(), item.dump(), "must be a number that a double holds exactly",
                          k_restore);
        } else if (!is_allowed(v, range)) {
            problems_.add("GC-RECORD-0016", at.pointer(), record_number(v), text_of_rule(range), k_restore);
        }
    }

    template <class Rule>
    void read_value(const json& item, std::int64_t& v, const Step& at, const Rule& rule) {
        if (!item.is_number_integer() || item > std::numeric_limits<std::int64_t>::max()) {
            wrong_type(item, "a whole number", at);
            return;
        }
        v = item.get<std::int64_t>();
        if (const Range range = range_of(rule); !is_allowed(static_cast<double>(v), range)) {
            problems_.add("GC-RECORD-0016", at.pointer(), std::to_string(v), text_of_rule(range), k_restore);
        }
    }

    template <class Rule>
    void read_value(const json& item, int& v, const Step& at, const Rule& rule) {
        std::int64_t whole = 0;
        read_value(item, whole, at, rule);
        v = static_cast<int>(
            std::clamp<std::int64_t>(whole, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    }

    template <class Rule>
    void read_value(const json& item, std::string& v, const Step& at, const Rule& rule) {
        if (!item.is_string()) {
            wrong_type(item, "a text", at);
            return;
        }
        v = item.get<std::string>();
        if constexpr (std::same_as<Rule, std::initializer_list<const char*>>) {
            if (std::find(rule.begin(), rule.end(), v) == rule.end()) {
                unknown_word(at, v, rule);
            }
        }
    }

    template <class Rule>
    void read_value(const json& item, std::pair<double, double>& v, const Step& at, const Rule& rule) {
        std::array<double, 2> ends{};
        read(item, ends, at, rule);
        v = {ends[0], ends[1]};
    }
};

/// What a fault of the text means for a record.
void refuse_text(const gumcert::json::ParsingProblem& problem, RecordProblems& problems) {
    switch (problem.fault) {
        case Fault::duplicate_key:
            problems.add("GC-RECORD-0012", problem.pointer, "the key appears twice", "a key is used once in an object",
                         k_restore);
            break;
        case Fault::nul_character:
            problems.add("GC-RECORD-0016", problem.pointer, "a text with a NUL character (\\u0000)",
                         "texts of a record have none: documents would end there", k_restore);
            break;
        case Fault::depth:
            problems.add("GC-RECORD-0018", std::string(gumcert::json::parent_pointer(problem.pointer)),
                         "nested deeper than " + std::to_string(k_record_text.depth) + " levels",
                         "a record is at most that deep", k_restore);
            break;
        default:
            problems.add(
                "GC-RECORD-0011", problem.pointer,
                "parse error at " + text::line_and_column(problem.place) + ": " + problem.what,
                "a record is one JSON value in UTF-8, byte " + std::to_string(problem.offset + 1) + " breaks it",
                k_restore);
    }
}

/// The JSON value of a record; nothing when its text cannot be read to the end.
std::optional<json> value_of(const std::string& text, RecordProblems& problems) {
    return gumcert::json::parse(text, k_record_text,
                                [&](const gumcert::json::ParsingProblem& problem) { refuse_text(problem, problems); });
}

ReadRecord read_record_of(const std::string& text, const std::string& where, std::span<const std::string_view> kinds) {
    RecordProblems problems(where);
    if (text.size() > k_max_record_bytes) {
        problems.add("GC-RECORD-0010", "", std::to_string(text.size()) + " bytes",
                     "a record has at most " + std::to_string(k_max_record_bytes) + " bytes", k_restore);
        problems.throw_if_any();
    }
    std::optional<json> read = value_of(text, problems);
    problems.throw_if_any();

    json& root = *read;
    if (!root.is_object()) {
        problems.add("GC-RECORD-0015", "", root.type_name(), "must be an object", k_restore);
        problems.throw_if_any();
    }
    const auto schema = root.find("schema");
    if (schema == root.end() || *schema != EvaluationRecord::k_schema) {
        const std::optional<text::FileGuess> guess = text::guess_file(text);
        const bool is_other = guess && !(schema != root.end() && schema->is_string() &&
                                         schema->get<std::string>().starts_with("gumcert/record/"));
        problems.add("GC-RECORD-0020", "/schema",
                     schema == root.end()  ? "missing"
                     : schema->is_string() ? '"' + schema->get<std::string>() + '"'
                                           : schema->type_name(),
                     std::string("must be \"") + EvaluationRecord::k_schema + '"',
                     is_other ? "it is " + guess->what + ", and no record: " + guess->action
                              : "use a release of the program that knows this schema");
        problems.throw_if_any();
    }

    EvaluationRecord record;
    Reader reader(root, Step{}, problems);
    if (const auto kind = root.find("kind");
        kind != root.end() && kind->is_string() && std::find(kinds.begin(), kinds.end(), *kind) == kinds.end()) {
        const Step document;
        reader.unknown_word(document.child("kind"), kind->get<std::string>(), kinds);
    }
    describe(reader, record);
    reader.finish();
    problems.throw_if_any();
    if (record.rotary && !record.rotary->machine_frame && record.rotary->axis_line.empty()) {
        // Records without a frame of the machine gave the axis in the frame of the fixture the names of location
        // errors.
        record.rotary->axis_line = std::move(record.rotary->location_errors);
        record.rotary->location_errors.clear();
    }
    check_record(record, [&](const std::string& at, std::string what, std::string rule) {
        problems.add("GC-RECORD-0017", at, std::move(what), std::move(rule), k_restore);
    });
    problems.throw_if_any();
    root.erase(k_digest_key);
    if (!record.digest.empty()) {
        if (const std::string own = encoding::sha256(canonical_json(root)); own != record.digest) {
            problems.add("GC-RECORD-0021", std::string("/") + k_digest_key,
                         "SHA-256 of the record is " + own + ", and it states " + record.digest,
                         "a record states the digest of its own contents: this one was changed after it was written",
                         "take the record as the program wrote it, or evaluate its job again");
            problems.throw_if_any();
        }
    }
    return {std::move(record), std::move(root)};
}

}  // namespace

EvaluationRecord record_from_json(const std::string& text, const std::string& where) {
    return record_from_json(text, where, k_record_kinds);
}

EvaluationRecord record_from_json(const std::string& text, const std::string& where,
                                  std::span<const std::string_view> kinds) {
    return read_record_of(text, where, kinds).record;
}

ReadRecord read_record(const std::string& text, const std::string& where) {
    return read_record_of(text, where, k_record_kinds);
}

}  // namespace gumcert::reports
