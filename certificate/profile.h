#pragma once

#include <string>
#include <utility>
#include <vector>

#include "certificate/localised_text.h"

namespace gumcert::certificate {

/// What an accreditation body wants of a certificate, as data: templates/profiles/*.json, or a file of the laboratory.
struct Profile {
    std::string id, name;                ///< "ukas", "United Kingdom Accreditation Service"
    std::vector<std::string> sources;    ///< documents with edition that the settings follow
    int digits = 2;                      ///< significant digits of U: 1 or 2 (ILAC-P14:09/2020)
    std::string rounding = "half_even";  ///< "half_even" or "up"
    /// A result whose U is smaller than the capability: "raise" prints the capability, "outside" prints U and marks the
    /// result as outside of the accreditation, "refuse" is a critical finding
    std::string below_capability = "raise";
    std::string mixed_results = "mark";  ///< accredited and other results on one document: "mark", "separate", "refuse"
    bool plus_minus_in_tables = true;
    std::string k_position = "sentence";  ///< "sentence" where one k holds for all, else always "column"
    bool opinions_with_symbol = false;    ///< opinions may stand on a document with the symbol
    bool reproduction_sentence_mandatory = true;
    bool receipt_date_mandatory = false;
    bool reviewer_may_be_performer = true;
    std::vector<std::string> required_languages;      ///< at least these
    std::vector<LocalisedText> first_page_sentences;  ///< permanent sentences at the foot of the first page
    LocalisedText uncertainty_sentence;  ///< "" = the sentence of the record's case; has {k} and {coverage}

    /// Words of the program that laboratories of this body say otherwise. Profiles of the program only.
    struct Term {
        std::string language;  ///< "es"
        std::string word;      ///< as the wording of the program has it: "capacidad de medición y calibración"
        std::string term;      ///< as it is printed: "capacidad de medida y calibración"
        friend bool operator==(const Term&, const Term&) = default;
    };
    std::vector<Term> terms;

    friend bool operator==(const Profile&, const Profile&) = default;
};

}  // namespace gumcert::certificate
