#pragma once

#include "certificate/localised_text.h"

#include <string>
#include <vector>

namespace gumcert::reports {

/// A sentence of the program by its id and its arguments: what is needed to say it in another language.
struct IdentifiedSentence {
    struct Argument {
        std::string name, value;
        friend bool operator==(const Argument&, const Argument&) = default;
    };
    std::string id;                   ///< "conformity/convolution", of templates/wording/sentences.json
    std::vector<Argument> arguments;  ///< in the order in which the English sentence has them
    std::string text;                 ///< the English sentence, as it stands in the record

    friend bool operator==(const IdentifiedSentence&, const IdentifiedSentence&) = default;
};

/// An input quantity of a budget as a person knows it.
struct InputQuantity {
    std::string name;
    certificate::LocalisedText description;
    std::string unit;  ///< UDUNITS-2: "nm/K"; "1" of a ratio
};

}  // namespace gumcert::reports
