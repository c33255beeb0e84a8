#include "evaluation/certificate_profile.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "certificate/section_data.h"
#include "encoding/file_bytes.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/certificate/certificate_statement.h"
#include "reports/forms_of_number.h"
#include "text/lists.h"

namespace gumcert::evaluation {

namespace {

namespace fs = std::filesystem;

/// An id is the name of a file: letters, digits, '-' and '_' only, so that it cannot lead out of the folder.
bool is_file_stem(const std::string& id) {
    constexpr std::size_t k_longest = 64;
    return !id.empty() && id.size() <= k_longest && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    });
}

std::string known_profiles(const fs::path& folder) {
    const std::vector<std::string> names = encoding::json_files_in(folder);
    return names.empty() ? "none" : text::listed(names);
}

/// The sentences of a profile for one item or for several: "{items?item|items}".
certificate::Profile with_forms_of_items(certificate::Profile profile, bool several) {
    const auto put = [&](std::string& text) {
        const std::vector<std::string> names = reports::names_with_forms(text);
        if (names == std::vector<std::string>{"items"}) {  // else braces of a person
            text = reports::with_forms_of(text, [&](const std::string&) { return !several; });
        }
    };
    for (certificate::LocalisedText& sentence : profile.first_page_sentences) {
        put(sentence.plain);
        for (auto& [language, text] : sentence.by_language) {
            put(text);
        }
    }
    return profile;
}

/// A certificate names its profile: a file of the laboratory that is called as one of the program is the same as it.
void refuse_a_name_of_the_program(const certificate::Profile& own, const fs::path& folder) {
    const fs::path file = folder / (own.id + ".json");
    std::error_code error;
    if (!is_file_stem(own.id) || !fs::exists(file, error)) {
        return;
    }
    // A copy in which the forms of one item are put is the same, as releases without these forms had it.
    if (!(with_forms_of_items(jobs::parse_profile(read_file(file), file.filename().string()), false) ==
          with_forms_of_items(own, false))) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-CERT-0301",
                            .where = "certificate/profile",
                            .what = "a profile of your own has the id \"" + own.id + "\" of one of the program",
                            .rule = "a document names its profile, and the two are not the same",
                            .action = "give it an id of its own, or name the profile of the program"});
    }
}

/// A word in place of another one may turn a sentence of the program round: "outside of the accreditation".
void refuse_terms_of_its_own(const certificate::Profile& own) {
    if (!own.terms.empty()) {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-CERT-0302",
            .where = "certificate/profile/terms",
            .what = "a profile of your own has " + text::count_of(static_cast<std::int64_t>(own.terms.size()), "term") +
                    " in place of words of the program",
            .rule = "what documents state is worded by the program and by its profiles",
            .action = "remove them; labels of your own stand in templates/wording/LANGUAGE.own.json"});
    }
}

}  // namespace

certificate::Profile certificate_profile(const certificate::CertificateData& data, const fs::path& templates) {
    const fs::path folder = templates / "profiles";
    if (data.own_profile) {
        refuse_terms_of_its_own(*data.own_profile);
        refuse_a_name_of_the_program(*data.own_profile, folder);
        return with_forms_of_items(*data.own_profile, certificate::has_several_items(data));
    }
    const fs::path file = folder / (data.profile + ".json");
    std::error_code error;
    if (!is_file_stem(data.profile) || !fs::exists(file, error)) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-CERT-0300",
                                              .where = "certificate/profile",
                                              .what = "there is no profile \"" + data.profile + "\"",
                                              .rule = "the profiles are " + known_profiles(folder),
                                              .action = "name one of them, or a file of your own beside the job"});
    }
    return with_forms_of_items(jobs::parse_profile(read_file(file), file.filename().string()),
                               certificate::has_several_items(data));
}

}  // namespace gumcert::evaluation
