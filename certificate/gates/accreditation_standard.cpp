#include "certificate/gates/accreditation_standard.h"

#include <string_view>

#include "certificate/text_words.h"

namespace gumcert::certificate {

bool is_of_calibration_laboratories(const std::string& text) {
    // Names of standards bodies and their publications. Every word has to be one of them, the number or an edition: one
    // other word can turn the sentence round.
    constexpr std::u32string_view k_bodies =
        U" iso iec cei din en bs nf une uni cns abnt nbr ntp nmx ntc iram nch unit gb cnas jis q ks ss ns ds sn onorm "
        U"oenorm "
        U"csn pn msz sr stn sfs nen nbn evs lst lvs is i s as nzs sans gost t ";
    bool standard = false;
    bool others = false;
    for (const std::u32string& word : words_of(text)) {
        const bool digits = word.find_first_not_of(U"0123456789") == std::u32string::npos;
        const std::string year(word.begin(), word.end());
        if (word == U"17025" || word == U"27025") {  // GB/T 27025 is ISO/IEC 17025
            others = others || standard;
            standard = true;
        } else if (digits && standard) {
            const bool edition =
                // Years of the editions of 2005 and 2017 and of their national adoptions; a year between belongs to
                // neither. "03" is the month of an edition.
                (word.size() == 4 && ((year >= "2005" && year <= "2010") || (year >= "2017" && year <= "2024"))) ||
                (word.size() == 2 && year <= "12");
            others = others || !edition;
        } else {
            others = others || k_bodies.find(U' ' + word + U' ') == std::u32string_view::npos;
        }
    }
    return standard && !others;
}

}  // namespace gumcert::certificate
