#include "reports/record/record_text.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reports/record/canonical_json.h"

namespace gumcert::reports {

namespace {

using nlohmann::json;

/// Builds the JSON value while it looks for what nlohmann-json lets pass: duplicate keys and deep nesting.
class Parser final : public nlohmann::json_sax<json> {
public:
    explicit Parser(RecordProblems& problems) : problems_(problems) {}
    json root;

    bool null() override { return put(json()); }
    bool boolean(bool v) override { return put(v); }
    bool number_integer(number_integer_t v) override { return put(v); }
    bool number_unsigned(number_unsigned_t v) override { return put(v); }
    bool number_float(number_float_t v, const string_t&) override { return put(v); }
    bool string(string_t& v) override {
        if (v.find('\0') != std::string::npos) {
            problems_.add("GC-RECORD-0016", pointer() + here(), "a text with a NUL character (\\u0000)",
                          "texts of a record have none: documents would end there", k_restore);
        }
        return put(std::move(v));
    }
    bool binary(binary_t&) override { return false; }  // JSON text has none
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [place, added] = stack_.back()->emplace(std::move(name), nullptr);
        if (!added) {
            problems_.add("GC-RECORD-0012", pointer() + "/" + pointer_token(place.key()), "the key appears twice",
                          "a key is used once in an object", k_restore);
        }
        key_ = &place.key();
        item_ = &*place;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: …": the part after the bracket is for
        // people
        const std::string text = e.what();
        const std::size_t bracket = text.find("] ");
        problems_.add("GC-RECORD-0011", pointer(), bracket == std::string::npos ? text : text.substr(bracket + 2),
                      "a record is one JSON value in UTF-8, byte " + std::to_string(position) + " breaks it",
                      k_restore);
        return false;
    }

private:
    RecordProblems& problems_;
    std::vector<json*> stack_;
    std::vector<std::string> path_;
    const std::string* key_ = nullptr;  ///< of the object that is open, where the next value goes to
    json* item_ = nullptr;

    /// The key or the index that the next value goes to, behind pointer().
    [[nodiscard]] std::string here() const {
        return stack_.empty()              ? ""
               : stack_.back()->is_array() ? "/" + std::to_string(stack_.back()->size())
                                           : "/" + pointer_token(*key_);
    }

    [[nodiscard]] std::string pointer() const {
        std::string text;
        for (const std::string& token : path_) {
            text += "/" + token;
        }
        return text;
    }

    json* place(json v) {
        if (stack_.empty()) {
            root = std::move(v);
            return &root;
        }
        json& parent = *stack_.back();
        if (parent.is_array()) {
            parent.push_back(std::move(v));
            return &parent.back();
        }
        *item_ = std::move(v);
        return item_;
    }

    bool put(json v) {
        place(std::move(v));
        return true;
    }

    bool open(json v) {
        if (stack_.size() >= k_max_json_depth) {
            problems_.add("GC-RECORD-0018", pointer(),
                          "nested deeper than " + std::to_string(k_max_json_depth) + " levels",
                          "a record is at most that deep", k_restore);
            return false;
        }
        if (!stack_.empty()) {
            path_.push_back(stack_.back()->is_array() ? std::to_string(stack_.back()->size()) : pointer_token(*key_));
        }
        stack_.push_back(place(std::move(v)));
        return true;
    }

    bool close() {
        stack_.pop_back();
        if (!path_.empty()) {
            path_.pop_back();
        }
        return true;
    }
};

}  // namespace

nlohmann::json json_of_text(const std::string& text, RecordProblems& problems) {
    Parser parser(problems);
    static_cast<void>(json::sax_parse(text, &parser));
    return std::move(parser.root);
}

}  // namespace gumcert::reports
