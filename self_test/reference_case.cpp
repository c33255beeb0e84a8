#include "self_test/reference_case.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::self_test {

namespace {

using nlohmann::json;

constexpr double k_rounding = 1e-9;       // a tolerance is itself a rounded number
constexpr int k_largest_exponent = 1000;  // beyond it no double is left

[[noreturn]] void refuse_case(const std::string& id, const std::string& what) {
    throw gum::InputError(
        gum::Diagnostic{.code = "GC-SELF-0002",
                        .where = text::visible(id),
                        .what = what,
                        .rule = "a reference case is JSON with title, topic, source, jobs and expected values",
                        .action = "install the program again, or correct the case"});
}

/// Members of one object of a case.
class Members {
public:
    Members(const json& object, std::string id) : object_(object), id_(std::move(id)) {
        if (!object.is_object()) {
            refuse_case(id_, "a list, text or number stands where an object is expected");
        }
    }

    [[nodiscard]] const json* find(const char* key) const {
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }
    [[nodiscard]] const json& object(const char* key) const {
        const json* const found = find(key);
        if (found == nullptr || !found->is_object()) {
            refuse_case(id_, std::string("there is no object ") + key);
        }
        return *found;
    }
    [[nodiscard]] std::string text(const char* key, bool needed = false) const {
        const json* const found = find(key);
        if (found == nullptr && !needed) {
            return "";
        }
        if (found == nullptr || !found->is_string()) {
            refuse_case(id_, std::string(key) + " is no text");
        }
        return found->get<std::string>();
    }
    [[nodiscard]] std::optional<double> number(const char* key) const {
        const json* const found = find(key);
        if (found == nullptr) {
            return std::nullopt;
        }
        if (!found->is_number() || !(found->get<double>() > 0.0)) {
            refuse_case(id_, std::string(key) + " is no number above 0");
        }
        return found->get<double>();
    }

private:
    const json& object_;
    std::string id_;
};

/// The number that a source prints, with blanks between its digits or without; none where the text is no number.
std::optional<double> printed_number(std::string text) {
    std::erase(text, ' ');
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stopped == end ? std::optional(value) : std::nullopt;
}

ExpectedValue expected_value(const json& stated, const std::string& id) {
    const Members members(stated, id);
    ExpectedValue value{.quantity = members.text("quantity", true),
                        .kind = members.text("kind", true),
                        .input = members.text("input"),
                        .unit = members.text("unit"),
                        .note = members.text("note")};
    const json* const printed = members.find("printed");
    const json* const computed = members.find("computed");
    if ((printed == nullptr) == (computed == nullptr)) {
        refuse_case(id, value.name() + " is neither printed nor computed, or both");
    }
    value.is_printed = printed != nullptr;
    const json& number = printed != nullptr ? *printed : *computed;
    if (number.is_boolean()) {
        value.wanted = number.get<bool>();
        value.text = number.get<bool>() ? "yes" : "no";
    } else if (number.is_number()) {
        value.wanted = number.get<double>();
        value.text = text::shortest(number.get<double>());
    } else if (number.is_string()) {
        value.text = number.get<std::string>();
        if (const std::optional<double> read = printed_number(value.text)) {
            value.wanted = *read;
        } else {
            value.wanted = value.text;
        }
    } else {
        refuse_case(id, value.name() + " is no number, answer or text");
    }
    if (const json* const tolerance = members.find("tolerance"); tolerance != nullptr && tolerance->is_string()) {
        value.tolerance_formula = tolerance->get<std::string>();
    } else {
        value.tolerance = members.number("tolerance");
    }
    value.relative_tolerance = members.number("relative_tolerance");
    if (const json* const found = members.find("found"); found != nullptr && found->is_array()) {
        for (const json& path : *found) {
            value.found.push_back(path.is_string() ? path.get<std::string>() : "");
        }
    } else if (found != nullptr) {
        value.found.push_back(members.text("found"));
    }
    value.not_compared = members.text("not_compared");
    if (value.found.empty() == value.not_compared.empty()) {
        refuse_case(id, value.name() + " says neither where it is found nor why it is not compared, or both");
    }
    return value;
}

}  // namespace

std::string ExpectedValue::name() const {
    return quantity + " " + kind + (input.empty() ? "" : " [" + input + "]");
}

int ExpectedValue::digits() const {
    const double* const number = std::get_if<double>(&wanted);
    if (number == nullptr || !std::isfinite(*number)) {
        return 0;
    }
    const std::string mantissa = text.substr(0, text.find_first_of("eE"));
    std::string digits;
    std::copy_if(mantissa.begin(), mantissa.end(), std::back_inserter(digits),
                 [](unsigned char c) { return std::isdigit(c) != 0; });
    const std::size_t first = digits.find_first_not_of('0');
    return static_cast<int>(first == std::string::npos ? 1 : digits.size() - first);
}

double ExpectedValue::half_unit() const {
    std::string plain = text;
    std::erase(plain, ' ');
    const std::size_t exponent_at = plain.find_first_of("eE");
    const std::string mantissa = plain.substr(0, exponent_at);
    int exponent = 0;
    if (exponent_at != std::string::npos) {
        const char* begin = plain.data() + exponent_at + 1;
        begin += begin < plain.data() + plain.size() && *begin == '+' ? 1 : 0;
        std::from_chars(begin, plain.data() + plain.size(), exponent);
    }
    exponent = std::clamp(exponent, -k_largest_exponent, k_largest_exponent);
    const std::size_t point = mantissa.find('.');
    exponent -= point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    return 0.5 * std::pow(10.0, exponent);
}

ReferenceCase reference_case_from_json(const std::string& text, const std::string& id) {
    const std::optional<json> document = gumcert::json::parse_faultless(text, {});
    if (!document) {
        refuse_case(id, "the text is no JSON");
    }
    const Members members(*document, id);
    ReferenceCase result{.id = id,
                         .title = members.text("title", true),
                         .topic = members.text("topic", true),
                         .checked_by = members.text("checked_by", true),
                         .note = members.text("note"),
                         .data = members.find("data") == nullptr ? json::object() : members.object("data")};
    (void)members.object("jobs");
    result.jobs = nlohmann::ordered_json::parse(text)["jobs"];
    const Members source(members.object("source"), id);
    result.document = source.text("document", true);
    result.place = source.text("place");
    result.seen = source.text("seen", true);
    if (const std::string unseen = source.text("place_unverified"); !unseen.empty()) {
        result.place = unseen;
        result.is_place_seen = false;
    }
    constexpr std::array<std::string_view, 3> k_seen{"opened", "quoted", "recalled"};
    if (std::find(k_seen.begin(), k_seen.end(), result.seen) == k_seen.end()) {
        refuse_case(id, "seen is none of opened, quoted and recalled");
    }
    const json* const expected = members.find("expected");
    if (expected == nullptr || !expected->is_array()) {
        refuse_case(id, "there is no list expected");
    }
    for (const json& value : *expected) {
        result.expected.push_back(expected_value(value, id));
    }
    return result;
}

int digits_reached(double expected, int digits, double found) {
    const double difference = std::abs(found - expected);
    if (!(difference <= std::abs(expected))) {
        return 0;
    }
    if (expected == 0.0) {
        return digits;
    }
    const double first = std::floor(std::log10(std::abs(expected)));
    for (int m = digits; m > 0; --m) {
        const double half = 0.5 * std::pow(10.0, first - m + 1);
        // In double precision more than 15 digits cannot be told apart from the last bits.
        if (difference <= half * (1.0 + k_rounding) + 4e-16 * std::abs(expected)) {
            return m;
        }
    }
    return 0;
}

}  // namespace gumcert::self_test
