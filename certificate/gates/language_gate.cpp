#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "certificate/certificate_fields.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"

namespace gumcert::certificate {

namespace {

/// Walks the description of certificate data and meets every text that may be given in several languages.
class MissingLanguages {
public:
    MissingLanguages(FindingList& found, const std::vector<std::string>& languages, std::string at)
        : found_(found), languages_(languages), at_(std::move(at)) {}

    template <class Type, class... Rule>
    void operator()(const char* key, const Type& member, const Rule&...) {
        look(at_ + "/" + key, member);
    }
    template <class Type>
    void operator()(const char* key, const Type& member, std::initializer_list<const char*>) {
        look(at_ + "/" + key, member);
    }
    template <class Type, class... Rule>
    void needed(const char* key, const Type& member, const Rule&...) {
        look(at_ + "/" + key, member);
    }
    template <class Type>
    void needed(const char* key, const Type& member, std::initializer_list<const char*>) {
        look(at_ + "/" + key, member);
    }
    template <class Type, class... Rule>
    void added(const char* key, const Type& member, const Rule&...) {
        look(at_ + "/" + key, member);
    }
    template <class Type, class... Rule>
    void stated(const char* key, const Type& member, const Rule&...) {
        look(at_ + "/" + key, member);
    }
    template <class Type>
    void stated(const char* key, const Type& member, std::initializer_list<const char*>) {
        look(at_ + "/" + key, member);
    }
    template <class Type>
    void filled(const char*, const Type&) {}
    template <class Type>
    void filled_if_any(const char*, const Type&) {}
    template <class Type>
    void named(const char*, const Type&, std::initializer_list<const char*>) {}
    template <class Function>
    void group(const char*, const Function&) {}

    void look(const std::string& at, const LocalisedText& text) {
        for (const std::string& language : languages_) {
            const bool stated = std::any_of(text.by_language.begin(), text.by_language.end(),
                                            [&](const auto& one) { return one.first == language; });
            // A plain text holds for every language, as a number or a name does.
            if (!text.by_language.empty() && text.plain.empty() && !stated) {
                found_.add(FindingSeverity::minor, "R17", iso_17025("7.8.1.2"), at,
                           "the text is not given in \"" + language + "\", a language of the certificate",
                           "Give it in every language of the certificate, or once for all of them.");
            }
        }
    }

private:
    FindingList& found_;
    const std::vector<std::string>& languages_;
    std::string at_;

    template <class Type>
    void look(const std::string& at, const Type& member) {
        if constexpr (requires { member.has_value(); }) {
            if (member) {
                look(at, *member);
            }
        } else if constexpr (std::is_arithmetic_v<Type> || std::is_enum_v<Type> || std::same_as<Type, std::string> ||
                             std::same_as<Type, std::pair<double, double>>) {
            return;
        } else if constexpr (requires { member.size(); }) {
            for (std::size_t i = 0; i < member.size(); ++i) {
                look(at + "/" + std::to_string(i), member[i]);
            }
        } else {
            MissingLanguages inside(found_, languages_, at);
            describe(inside, member);
        }
    }
};

}  // namespace

std::vector<Finding> language_findings(const Certificate& certificate) {
    FindingList found(certificate.data);
    MissingLanguages archive(found, certificate.data.languages, "");
    describe(archive, certificate.data);
    MissingLanguages names(found, certificate.data.languages, "");
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            names.look(column.result, column.name);
        }
    }
    return found.take();
}

}  // namespace gumcert::certificate
