#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "certificate/certificate_fields.h"

namespace gumcert::test {

/// Walks the description of certificate data and states keys of it: one alone, or every one. What is stated already
/// keeps its value.
class KeyFiller {
public:
    static constexpr std::size_t k_every = static_cast<std::size_t>(-1);

    /// \param wanted  number of the key, in the order of the description; or k_every
    /// \param turn    which of its words a key with a choice of words gets
    explicit KeyFiller(std::size_t wanted, std::size_t turn = 0) : wanted_(wanted), turn_(turn) {}

    template <class Type, class... Rule>
    void operator()(const char* key, Type& member, const Rule&... rule) {
        key_of(key, false, [&] { value(member, rule...); });
    }
    template <class Type>
    void operator()(const char* key, Type& member, std::initializer_list<const char*> words) {
        key_of(key, false, [&] { value(member, words); });
    }
    template <class Type, class... Rule>
    void needed(const char* key, Type& member, const Rule&... rule) {
        key_of(key, true, [&] { value(member, rule...); });
    }
    template <class Type>
    void needed(const char* key, Type& member, std::initializer_list<const char*> words) {
        key_of(key, true, [&] { value(member, words); });
    }
    template <class Type, class... Rule>
    void added(const char* key, Type& member, const Rule&... rule) {
        key_of(key, false, [&] { value(member, rule...); });
    }
    /// Limits of points replace those of the specification: what they give is in the verdicts.
    template <class Type, class... Rule>
    void stated(const char* key, Type& member, const Rule&... rule) {
        if (std::string_view(key) != "limits") {
            (*this)(key, member, rule...);
        }
    }
    template <class Type>
    void stated(const char* key, Type& member, std::initializer_list<const char*> words) {
        (*this)(key, member, words);
    }
    template <class Type>
    void filled(const char*, Type&) {}
    template <class Type>
    void filled_if_any(const char*, Type&) {}

    [[nodiscard]] std::size_t count() const { return at_; }
    [[nodiscard]] const std::string& stated() const { return stated_; }  ///< its place: "/item/owner"

private:
    std::size_t wanted_, turn_;
    std::size_t at_ = 0;
    bool inside_new_ = false;  ///< of an object that is being stated: what it needs is stated, too
    bool needed_ = false;
    std::string path_, stated_;

    template <class Visit>
    void key_of(const char* key, bool needed, const Visit& visit) {
        const std::string outer = std::exchange(path_, path_ + "/" + key);
        const bool outer_needed = std::exchange(needed_, needed);
        visit();
        path_ = outer;
        needed_ = outer_needed;
    }

    template <class Type, class... Rule>
    void value(Type& member, const Rule&... rule) {
        if constexpr (requires { member.has_value(); }) {
            element(
                member.has_value(), [&]() -> auto& { return *member; }, [&] { member.emplace(); },
                [&] { member.reset(); }, rule...);
        } else if constexpr (requires { member.emplace_back(); } && !std::same_as<Type, std::string>) {
            element(
                !member.empty(), [&]() -> auto& { return member.front(); }, [&] { member.emplace_back(); },
                [&] { member.pop_back(); }, rule...);
        } else if constexpr (requires(KeyFiller & f) { describe(f, member); }) {
            describe(*this, member);
        } else {
            leaf(member, rule...);
        }
    }

    /// What may be missing as a whole: it is made where a key in it is wanted.
    template <class There, class Make, class Remove, class... Rule>
    void element(bool is_there, const There& there, const Make& make, const Remove& remove, const Rule&... rule) {
        if (is_there) {
            value(there(), rule...);
            return;
        }
        const std::size_t from = at_;
        make();
        value(there(), rule...);
        const bool hit = wanted_ == k_every || (wanted_ >= from && wanted_ < at_) || (inside_new_ && needed_);
        remove();
        if (!hit) {
            return;
        }
        at_ = from;
        make();
        const bool outer = std::exchange(inside_new_, true);
        value(there(), rule...);
        inside_new_ = outer;
    }

    template <class Type, class... Rule>
    void leaf(Type& member, const Rule&... rule) {
        if (wanted_ == at_) {
            stated_ = path_;
        }
        if (wanted_ == k_every || wanted_ == at_ || (inside_new_ && needed_)) {
            put(member, rule...);
        }
        ++at_;
    }

    static void put(bool& v) { v = true; }
    template <class... Rule>
    static void put(double& v, const Rule&...) {
        v = v == 0.0 ? 0.5 : v;
    }
    static void put(int& v, certificate::NumberRule) { v = 2; }
    static void put(certificate::LocalisedText& v) {
        if (v.empty()) {
            v.by_language = {{"en", "Words"}, {"de", "Worte"}, {"zh-Hant", "文字"}, {"es", "Palabras"}};
        }
    }
    static void put(std::string& v) { v = v.empty() ? "Text 1" : v; }
    void put(std::string& v, std::initializer_list<const char*> words) const {
        if (v.empty() || turn_ > 0) {
            v = *(words.begin() + static_cast<std::ptrdiff_t>((turn_ + words.size() - 1) % words.size()));
        }
    }
    static void put(std::string& v, certificate::TextForm form) {
        using certificate::TextForm;
        if (!v.empty()) {
            return;
        }
        switch (form) {
            case TextForm::date:
                v = "2026-03-01";
                break;
            case TextForm::unit:
                v = "nm";
                break;
            case TextForm::country:
                v = "DE";
                break;
            case TextForm::sha256:
                v = std::string(64, 'a');
                break;
            case TextForm::language:
                v = "en";
                break;
            case TextForm::decision_rule:
                v = "DR-03";
                break;
            case TextForm::profile:
                v = "ilac";
                break;
            default:
                v = "Text 1";
        }
    }
};

}  // namespace gumcert::test
