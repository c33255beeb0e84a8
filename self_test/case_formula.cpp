#include "self_test/case_formula.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/visible_text.h"

namespace gumcert::self_test {

namespace {

using Row = std::vector<double>;

constexpr int k_deepest = 64;  // parentheses, functions and signs inside each other

/// Sum of numbers whose sizes differ much: what each addition loses is added at the end (Neumaier).
double exact_sum(const Row& numbers) {
    double sum = 0.0;
    double lost = 0.0;
    for (const double x : numbers) {
        const double next = sum + x;
        lost += std::abs(sum) >= std::abs(x) ? (sum - next) + x : (x - next) + sum;
        sum = next;
    }
    return sum + lost;
}

class Formula {
public:
    Formula(const std::string& text, const std::function<CaseValue(const std::string&)>& value_at)
        : text_(text), value_at_(value_at) {}

    CaseValue value() {
        CaseValue result = comparison();
        if (skip_blanks() < text_.size()) {
            refuse("something stands behind its end: " + text::in_quotes(text_.substr(at_)));
        }
        return result;
    }

private:
    const std::string& text_;
    const std::function<CaseValue(const std::string&)>& value_at_;
    std::size_t at_ = 0;
    int depth_ = 0;

    [[noreturn]] void refuse(std::string what) const {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-SELF-0001",
            .where = text::visible(text_),
            .what = std::move(what),
            .rule = "a formula of a reference case has numbers, paths in braces, + - * / ^, one comparison and the "
                    "functions that are listed",
            .action = "correct the formula in the case"});
    }

    std::size_t skip_blanks() {
        while (at_ < text_.size() && text_[at_] == ' ') {
            ++at_;
        }
        return at_;
    }

    bool take(std::string_view sign) {
        if (std::string_view(text_).substr(skip_blanks()).starts_with(sign)) {
            at_ += sign.size();
            return true;
        }
        return false;
    }

    double number(const CaseValue& value) const {
        if (const double* const found = std::get_if<double>(&value)) {
            return *found;
        }
        refuse("a number is needed where a text, a row or an answer stands");
    }

    template <class Operation>
    CaseValue each(const CaseValue& value, const Operation& operation) const {
        if (const Row* const row = std::get_if<Row>(&value)) {
            Row result(row->size());
            std::transform(row->begin(), row->end(), result.begin(), operation);
            return result;
        }
        return operation(number(value));
    }

    template <class Operation>
    CaseValue each(const CaseValue& a, const CaseValue& b, const Operation& operation) const {
        const Row* const left = std::get_if<Row>(&a);
        const Row* const right = std::get_if<Row>(&b);
        if (left == nullptr && right == nullptr) {
            return operation(number(a), number(b));
        }
        if (left != nullptr && right != nullptr && left->size() != right->size()) {
            refuse("rows of " + std::to_string(left->size()) + " and " + std::to_string(right->size()) + " numbers");
        }
        Row result((left != nullptr ? left : right)->size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = operation(left != nullptr ? (*left)[i] : number(a), right != nullptr ? (*right)[i] : number(b));
        }
        return result;
    }

    CaseValue comparison() {
        const CaseValue left = sum();
        for (const std::string_view sign : {"<=", ">=", "==", "<", ">"}) {
            if (take(sign)) {
                const double a = number(left);
                const double b = number(sum());
                return sign == "<="   ? a <= b
                       : sign == ">=" ? a >= b
                       : sign == "==" ? a == b
                       : sign == "<"  ? a < b
                                      : a > b;
            }
        }
        return left;
    }

    CaseValue sum() {
        CaseValue result = product();
        while (true) {
            if (take("+")) {
                result = each(result, product(), [](double a, double b) { return a + b; });
            } else if (take("-")) {
                result = each(result, product(), [](double a, double b) { return a - b; });
            } else {
                return result;
            }
        }
    }

    CaseValue product() {
        CaseValue result = signed_power();
        while (true) {
            if (take("*")) {
                result = each(result, signed_power(), [](double a, double b) { return a * b; });
            } else if (take("/")) {
                result = each(result, signed_power(), [this](double a, double b) {
                    if (b == 0.0) {
                        refuse("a number is divided by zero");
                    }
                    return a / b;
                });
            } else {
                return result;
            }
        }
    }

    CaseValue signed_power() {
        if (++depth_ > k_deepest) {
            refuse("more than " + std::to_string(k_deepest) + " parentheses, functions and signs inside each other");
        }
        CaseValue result = take("-") ? each(signed_power(), [](double x) { return -x; }) : power();
        --depth_;
        return result;
    }

    CaseValue power() {
        const CaseValue base = primary();
        return take("^") ? each(base, signed_power(), [](double a, double b) { return std::pow(a, b); }) : base;
    }

    CaseValue primary() {
        if (take("(")) {
            CaseValue result = comparison();
            close(")");
            return result;
        }
        if (take("{")) {
            const std::size_t end = text_.find('}', at_);
            if (end == std::string::npos) {
                refuse("a brace is not closed");
            }
            const std::string path = text_.substr(at_, end - at_);
            at_ = end + 1;
            return value_at_(path);
        }
        const std::size_t begin = skip_blanks();
        const auto is_letter = [this](std::size_t i) {
            return i < text_.size() && (std::isalpha(static_cast<unsigned char>(text_[i])) != 0 || text_[i] == '_');
        };
        if (is_letter(begin)) {
            while (is_letter(at_)) {
                ++at_;
            }
            return named(text_.substr(begin, at_ - begin));
        }
        double value = 0.0;
        const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
        if (error != std::errc()) {
            refuse(begin < text_.size() ? "no number stands at " + text::in_quotes(text_.substr(begin))
                                        : "it ends where a number should stand");
        }
        at_ = static_cast<std::size_t>(end - text_.data());
        return value;
    }

    void close(std::string_view sign) {
        if (!take(sign)) {
            refuse("a parenthesis is not closed");
        }
    }

    CaseValue named(const std::string& name) {
        if (name == "pi") {
            return std::numbers::pi;
        }
        if (!take("(")) {
            refuse("there is no name " + text::in_quotes(name));
        }
        std::vector<CaseValue> given{comparison()};
        while (take(",")) {
            given.push_back(comparison());
        }
        close(")");
        if (name == "max" || name == "hypot") {
            CaseValue result = given.front();
            for (std::size_t i = 1; i < given.size(); ++i) {
                result = name == "max" ? each(result, given[i], [](double a, double b) { return std::max(a, b); })
                                       : each(result, given[i], [](double a, double b) { return std::hypot(a, b); });
            }
            return result;
        }
        if (name == "shorthand") {
            return shorthand(given);
        }
        if (given.size() != 1) {
            refuse(name + " takes one value");
        }
        return of_one(name, given.front());
    }

    CaseValue of_one(const std::string& name, const CaseValue& value) const {
        if (name == "sum" || name == "mean") {
            const Row* const row = std::get_if<Row>(&value);
            if (row == nullptr || row->empty()) {
                refuse(name + " takes a row of numbers");
            }
            return name == "sum" ? exact_sum(*row) : exact_sum(*row) / static_cast<double>(row->size());
        }
        if (name == "abs") {
            return each(value, [](double x) { return std::abs(x); });
        }
        if (name == "floor") {
            return each(value, [](double x) { return std::floor(x); });
        }
        if (name == "sqrt") {
            return each(value, [](double x) { return std::sqrt(x); });
        }
        if (name == "ln") {
            return each(value, [](double x) { return std::log(x); });
        }
        if (name == "normal_quantile") {
            return each(value, [this](double p) {
                if (!(p > 0.0 && p < 1.0)) {
                    refuse("normal_quantile takes a probability between 0 and 1");
                }
                return gum::standard_normal_quantile(p);
            });
        }
        refuse("there is no function " + text::in_quotes(name));
    }

    /// Printed value and printed uncertainty as "0.1039(23)", JCGM 100:2008, 7.2.2.
    CaseValue shorthand(const std::vector<CaseValue>& given) const {
        const std::string* const value = given.size() == 2 ? std::get_if<std::string>(&given[0]) : nullptr;
        const std::string* const u = given.size() == 2 ? std::get_if<std::string>(&given[1]) : nullptr;
        if (value == nullptr || u == nullptr) {
            refuse("shorthand takes a printed value and a printed uncertainty");
        }
        std::string digits = *u;
        std::erase(digits, '.');
        digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
        return *value + "(" + digits + ")";
    }
};

}  // namespace

CaseValue value_of_formula(const std::string& formula,
                           const std::function<CaseValue(const std::string& path)>& value_at) {
    return formula.find('{') == std::string::npos ? value_at(formula) : Formula(formula, value_at).value();
}

}  // namespace gumcert::self_test
