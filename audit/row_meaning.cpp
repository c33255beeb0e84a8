#include "audit/row_meaning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/comment_pieces.h"
#include "audit/expanded_uncertainty.h"
#include "audit/word_line.h"
#include "certificate/text_words.h"

namespace gumcert::audit {
namespace {

bool names_reference(const WordLine& words) {
    return words.has_word("standard", {"deviation", "uncert", "unsicherheit", "error"}) ||
           words.has_word("normal", {"distribut", "verteil"}) ||
           words.has_any({"reference",       "referenz",    "standards ", "master",
                          "normals ",        "normale ",    "ref ",       "bezugsnormal",
                          "gebrauchsnormal", "gauge block", "gage block", "endmass",
                          "parallelendmass", "calibrator",  "kalibrator", "comparator",
                          "komparator",      "laser",       "cmm ",       "kmg ",
                          "patron ",         "etalon ",     "*標準器",    "*标准器"});
}
bool names_item(const WordLine& words) {
    return words.has_any({"dut ", "uut ", "iut ", "item", "prufling", "pruefling", "kalibriergegenstand",
                          "device under", "unit under", "instrument under", "customer", "kunden", "calibrando",
                          "equipo bajo", "instrument a etalonner", "*被校", "*待校"});
}

/// What a row is made of, whatever device it belongs to; `other` where the words name no kind of effect.
Contributor kind_of_effect(const WordLine& words, std::string_view raw) {
    // The order decides where words name two effects: temperature comes late, since its words stand in the names of
    // many others, as in "thermal expansion" or "resolution of the temperature sensor".
    if (words.has_any({"dead path", "deadpath", "totstrecke", "totweg"})) {
        return Contributor::dead_path;
    }
    if (words.has_any({"refractive", "brechung", "brechzahl", "edlen", "ciddor"}) ||
        (words.has_any({"wavelength", "wellenlange"}) && !words.has_any({"vacuum", "vakuum", "laser"}))) {
        return Contributor::refractive_index;
    }
    if (words.has_any({"resolut",        "auflos",         "aufloes",    "ziffernschritt", "readab",
                       "ablesbar",       "skalenteil",     "skalenwert", "teilungswert",   "least count",
                       "scale interval", "scale division", "digitis",    "digitiz",        "quantis",
                       "quantiz",        "resoluc",        "*解析度",    "*分辨力",        "*分辨率"})) {
        return names_reference(words) ? Contributor::reference_resolution : Contributor::item_resolution;
    }
    if (words.has_any({"bath ",        "bad ",        "badhomogen",  "furnace",
                       "ofen",         "chamber",     "kammer",      "homogen",
                       "inhomogen",    "humidity",    "feuchte",     "luftfeucht",
                       "air pressure", "luftdruck",   "barometric",  "ambient pressure",
                       "buoyancy",     "auftrieb",    "air density", "luftdichte",
                       "vibration",    "environment", "umgebung",    "bano ",
                       "horno ",       "enceinte",    "empuje",      "poussee de",
                       "uniformidad",  "humedad",     "humidite",    "condiciones ambi",
                       "*浮力",        "*均勻性",     "*均匀性",     "*濕度",
                       "*湿度"})) {
        return words.has("temperatur") &&
                       !words.has_any({"bath ", "bad ", "furnace", "ofen", "homogen", "bano ", "horno ", "enceinte"})
                   ? Contributor::temperature
                   : Contributor::environment;
    }
    if (words.has_any({"drift",       "stability",      "instability", "stabilitat",   "instabilitat",
                       "langzeit",    "long term",      "ageing",      "aging",        "alterung",
                       "since last",  "since the last", "since its",   "seit letzter", "seit der letzten",
                       "seit seiner", "seit ihrer",     "deriva ",     "derive ",      "estabilidad",
                       "stabilite",   "inestabilidad",  "instabilite", "*漂移",        "*穩定性",
                       "*稳定性"})) {
        return names_item(words) ? Contributor::item : Contributor::reference_drift;
    }
    if (words.has_any({"reproducib", "reproduzier", "vergleichprazision", "vergleichsprazision", "intermediate prec",
                       "operator", "bediener", "day to day", "between days", "zwischen den tagen", "seating", "*再現性",
                       "*重現性", "*复现性"})) {
        return Contributor::reproducibility;
    }
    if (words.has_any({"repeatab",        "repetib",  "wiederhol", "standard deviation",
                       "standardabweich", "std dev",  "stdev",     "scatter",
                       "streuung",        "random",   "zufallig",  "repeated readings",
                       "repeated meas",   "readings", "mean of",   "mittel aus",
                       "mittelwert von",  "type a",   "repetab",   "*重複性",
                       "*重复性"})) {
        return Contributor::repeatability;
    }
    if (words.has_any({"fit ", "fitting", "residual", "regression", "interpol", "polynom", "ausgleich", "restabweich",
                       "linearis", "linearity of the cur"})) {
        return Contributor::fit;
    }
    if (words.has_any({"expansion", "*ausdehnung", "cte ", "alpha ", "dilatacion", "dilatation", "*膨脹", "*膨胀"}) ||
        raw.find("α") != std::string_view::npos) {
        return Contributor::expansion;
    }
    if (words.has_any({"temperatur", "*temperatur", "temp ", "theta ", "thermal", "thermisch"}) ||
        raw.find("θ") != std::string_view::npos || raw.find("ϑ") != std::string_view::npos) {
        return Contributor::temperature;
    }
    if (words.has_any({"abbe",         "cosine",      "kosinus",   "cosinus",       "alignment",   "misalign",
                       "ausricht",     "mounting",    "aufspann",  "einspann",      "clamping",    "parallelism",
                       "parallelitat", "tilt",        "neigung",   "verkipp",       "eccentric",   "exzentri",
                       "off centre",   "off center",  "centring",  "centering",     "zentrier",    "datum",
                       "positioning",  "positionier", "placement", "perpendicular", "rechtwinklig"})) {
        return Contributor::alignment;
    }
    if (words.has_any({"form ", "formabweich", "form error", "roundness", "rundheit", "sphericity", "flatness",
                       "ebenheit", "reflector", "reflektor", "sphere", "kugel", "anvil", "messflache"})) {
        return Contributor::target_form;
    }
    return Contributor::other;
}

Contributor device_of(const WordLine& words) {
    if (names_item(words) || words.has_any({"hysteres", "umkehrspanne", "zero point", "nullpunkt", "backlash"})) {
        return Contributor::item;
    }
    if (names_reference(words) ||
        words.has_any({"certificate", "cert ", "kalibrierschein", "zertifikat", "calibration of", "kalibrierung de"})) {
        return Contributor::reference;
    }
    return Contributor::other;
}

/// The number that belongs to a keyword: directly behind it, directly in front of it, or behind it with a unit of the
/// row's kind in the same part of the sentence.
/// \param unit_needed  a number without unit may be that of a document or a class
std::optional<double> number_of_keyword(const Pieces& pieces, std::size_t keyword, const AuditedRow& row,
                                        bool unit_needed) {
    const auto usable = [&](const Piece& piece, bool with_unit) -> std::optional<double> {
        const std::optional<NumberOfRow> number = in_unit_of_row(piece, row);
        return number && (number->has_unit || !with_unit) ? std::optional(number->value) : std::nullopt;
    };
    std::size_t next = keyword + 1;
    while (next < pieces.size() && is_filler(pieces[next])) {
        ++next;
    }
    if (next < pieces.size() && pieces[next].kind == Piece::Kind::number) {
        if (const std::optional<double> value = usable(pieces[next], unit_needed)) {
            return value;
        }
    }
    // In front: a number whose unit is the piece before the keyword, or a bare number.
    for (std::size_t back = 1; back <= 3 && back <= keyword; ++back) {
        const Piece& piece = pieces[keyword - back];
        if (piece.kind == Piece::Kind::number) {
            const bool is_of_it = !is_argument(pieces, keyword - back);
            if (const std::optional<double> value = usable(piece, unit_needed || back > 1); value && is_of_it) {
                return value;
            }
            break;
        }
        if (ends_sentence(piece) || piece.is_sign(",")) {
            break;
        }
    }
    for (std::size_t i = next; i < pieces.size() && !ends_sentence(pieces[i]); ++i) {
        if (pieces[i].kind == Piece::Kind::number && !is_argument(pieces, i)) {
            if (const std::optional<double> value = usable(pieces[i], true)) {
                return value;
            }
        }
    }
    return std::nullopt;
}

struct Keyword {
    std::string_view beginning;    ///< of a word; with a space at its end the whole word
    std::string_view second = {};  ///< beginning of the next word, where one word is not enough
    std::string_view third = {};   ///< and of the one after it
    bool strong = true;            ///< says the origin without a number as well
    bool unit_needed = false;
};

/// Whether a word begins so, or is so.
bool is_keyword(const Piece& piece, std::string_view beginning) {
    return beginning.ends_with(' ')
               ? piece.kind == Piece::Kind::word && piece.word == beginning.substr(0, beginning.size() - 1)
               : piece.begins(beginning);
}

constexpr std::array<Keyword, 28> k_of_specification{{
    {.beginning = "mpe"},
    {.beginning = "fehlergrenz"},
    {.beginning = "grenzabweich"},
    {.beginning = "maximum", .second = "perm"},
    {.beginning = "permissible"},
    {.beginning = "zulassig", .strong = false},
    // Not every limit bounds an error: the limit of detection is a result of its own.
    {.beginning = "limit", .second = "of ", .third = "error"},
    {.beginning = "limit", .second = "of ", .third = "deviation"},
    {.beginning = "limit", .second = "of ", .third = "accuracy"},
    {.beginning = "limit", .second = "of ", .third = "toleran"},
    {.beginning = "accuracy", .second = "class", .unit_needed = true},
    {.beginning = "genauigkeitsklass", .unit_needed = true},
    // No specimen, no spectrum and nothing specific.
    {.beginning = "spec "},
    {.beginning = "specs "},
    {.beginning = "specification"},
    {.beginning = "specified"},
    {.beginning = "spezifikation"},
    {.beginning = "datasheet"},
    {.beginning = "data", .second = "sheet"},
    {.beginning = "datenblatt"},
    {.beginning = "herstellerangab"},
    {.beginning = "accuracy", .strong = false},
    {.beginning = "genauigkeit", .strong = false},
    {.beginning = "toleran", .strong = false, .unit_needed = true},
    {.beginning = "manufacturer", .strong = false, .unit_needed = true},
    {.beginning = "class", .strong = false, .unit_needed = true},
    {.beginning = "klass", .strong = false, .unit_needed = true},
    {.beginning = "grade", .strong = false, .unit_needed = true},
}};
constexpr std::array<Keyword, 14> k_of_resolution{{
    {.beginning = "resolut"},
    {.beginning = "auflos"},
    {.beginning = "aufloes"},
    {.beginning = "ziffernschritt"},
    {.beginning = "readab"},
    {.beginning = "ablesbar"},
    {.beginning = "skalenteil"},
    {.beginning = "skalenwert"},
    {.beginning = "teilungswert"},
    {.beginning = "least", .second = "count"},
    {.beginning = "scale", .second = "interval"},
    {.beginning = "scale", .second = "division"},
    {.beginning = "digit ", .strong = false, .unit_needed = true},
    {.beginning = "digits ", .strong = false, .unit_needed = true},
}};
constexpr std::array<Keyword, 8> k_of_limits{{
    {.beginning = "half", .second = "width"},
    {.beginning = "halfwidth"},
    {.beginning = "semi", .second = "range"},
    {.beginning = "halbweit"},
    {.beginning = "halbbreit"},
    {.beginning = "halbe", .second = "weite"},
    {.beginning = "halbe", .second = "breite"},
    {.beginning = "within", .strong = false},
}};
constexpr std::array<Keyword, 7> k_of_certificate{{
    {.beginning = "certificate", .unit_needed = true},
    {.beginning = "cert ", .unit_needed = true},
    {.beginning = "kalibrierschein", .unit_needed = true},
    {.beginning = "kalibrierzertifikat", .unit_needed = true},
    {.beginning = "zertifikat", .unit_needed = true},
    {.beginning = "calibration", .second = "report", .unit_needed = true},
    {.beginning = "prufschein", .unit_needed = true},
}};
constexpr std::array<Keyword, 9> k_of_readings{{
    {.beginning = "repeatab"},
    {.beginning = "repetib"},
    {.beginning = "wiederhol"},
    {.beginning = "standard", .second = "deviation"},
    {.beginning = "standardabweich"},
    {.beginning = "stdev"},
    {.beginning = "scatter "},
    {.beginning = "streuung"},
    {.beginning = "readings"},
}};

struct Found {
    std::optional<double> value;
    bool said = false;  ///< a strong keyword, with or without its number
};

Found find_keyword(const Pieces& pieces, std::span<const Keyword> keywords, const AuditedRow& row) {
    Found found;
    for (const Keyword& keyword : keywords) {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (!is_keyword(pieces[i], keyword.beginning)) {
                continue;
            }
            std::size_t last = i;
            bool follows = true;
            for (const std::string_view next : {keyword.second, keyword.third}) {
                if (next.empty() || !follows) {
                    continue;
                }
                ++last;
                if (last < pieces.size() && pieces[last].is_sign("-")) {
                    ++last;
                }
                follows = last < pieces.size() && is_keyword(pieces[last], next);
            }
            if (!follows) {
                continue;
            }
            found.said = found.said || keyword.strong;
            found.value = number_of_keyword(pieces, last, row, keyword.unit_needed);
            if (found.value) {
                return found;
            }
        }
    }
    return found;
}

/// "k = 2", "k: 2", "coverage factor 2", "Erweiterungsfaktor 2".
std::optional<double> coverage_factor(const Pieces& pieces) {
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        const bool symbol = pieces[i].kind == Piece::Kind::word && pieces[i].raw == "k";
        const bool words = pieces[i].word == "factor" || pieces[i].begins("erweiterungsfaktor");
        if (!symbol && !words) {
            continue;
        }
        std::size_t next = i + 1;
        while (next < pieces.size() && is_filler(pieces[next])) {
            ++next;
        }
        constexpr double k_largest = 20.0;
        if (next < pieces.size() && pieces[next].kind == Piece::Kind::number && !pieces[next].percent &&
            pieces[next].value > 0.0 && pieces[next].value < k_largest) {
            return pieces[next].value;
        }
    }
    return std::nullopt;
}
std::optional<double> coverage_probability(const Pieces& pieces) {
    for (const Piece& piece : pieces) {
        if (piece.kind == Piece::Kind::number && piece.percent && piece.value >= 0.5 && piece.value < 1.0) {
            return piece.value;
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> count_of(const Piece& piece) {
    constexpr double k_most = 1e6;
    if (piece.kind != Piece::Kind::number || piece.percent || piece.value < 1.0 || piece.value > k_most ||
        piece.value != std::floor(piece.value)) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(piece.value);
}

/// "n = 5", "mean of 10", "s of 6 days", "10 readings"; of what is called a mean, a number counts nothing where a unit follows.
std::optional<std::size_t> count_of_readings(const Pieces& pieces) {
    // What is called n is it, whatever else is counted beside it.
    for (std::size_t i = 0; i + 2 < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (piece.kind == Piece::Kind::word && (piece.raw == "n" || piece.raw == "N") &&
            (pieces[i + 1].is_sign("=") || pieces[i + 1].is_sign(":"))) {
            if (const std::optional<std::size_t> count = count_of(pieces[i + 2])) {
                return count;
            }
        }
    }
    std::optional<std::size_t> qualified;  // "3 single measurements of 5 readings" are 5 readings
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const auto follows = [&](std::size_t ahead, std::initializer_list<std::string_view> beginnings) {
            return i + ahead < pieces.size() && std::any_of(beginnings.begin(), beginnings.end(), [&](auto beginning) {
                       return pieces[i + ahead].begins(beginning);
                   });
        };
        const bool mean = piece.begins("mean") || piece.begins("average") || piece.begins("mittel") || piece.raw == "s";
        const auto counts_readings = [&](std::size_t ahead) {
            return follows(ahead, {"reading", "measurement", "repetition", "repeat", "messung", "ablesung",
                                   "wiederholung", "einzelmess", "observation", "lectura", "medicion", "pesada",
                                   "repeticion", "observacion", "lecture", "mesure", "pesee", "weighing", "wagung"});
        };
        // "Media de" and "moyenne de" alone count nothing, as an adjective is called so as well: "temperatura media de 3".
        const bool of_mean = mean && follows(1, {"of", "aus", "von", "over", "uber"}) && i + 2 < pieces.size();
        if (of_mean && (!has_unit(pieces[i + 2]) || counts_readings(4))) {  // "mean of 10 mV readings"
            if (const std::optional<std::size_t> count = count_of(pieces[i + 2])) {
                return count;
            }
        }
        const bool is_qualified =
            follows(1, {"equal", "identical", "single", "repeated", "independent", "successive", "consecutive",
                        "gleich", "identisch", "einzeln", "wiederholt", "unabhangig", "aufeinanderfolgend"});
        if (piece.kind == Piece::Kind::number && counts_readings(1)) {
            if (const std::optional<std::size_t> count = count_of(piece)) {
                return count;
            }
        }
        if (piece.kind == Piece::Kind::number && is_qualified && counts_readings(2) && !qualified) {
            qualified = count_of(piece);
        }
    }
    return qualified;
}

/// "ν = 9", "dof 9", "9 degrees of freedom", "Freiheitsgrade: 9", "9 grados de libertad".
std::optional<double> degrees_of_freedom(const Pieces& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (piece.kind != Piece::Kind::word) {
            continue;
        }
        const bool romance = (piece.begins("grado") || piece.begins("degre")) && i + 2 < pieces.size() &&
                             pieces[i + 1].word == "de" && pieces[i + 2].begins("libert");
        const bool behind = piece.begins("freiheitsgrad") || piece.begins("degrees") || piece.word == "dof" || romance;
        const bool symbol = piece.raw == "ν" || piece.raw == "nu" || piece.raw == "df" || piece.word == "dof" ||
                            piece.begins("freiheitsgrad") || piece.word == "freedom" || piece.word == "libertad" ||
                            piece.word == "liberte";
        std::size_t next = i + 1;
        while (symbol && next < pieces.size() && is_filler(pieces[next])) {
            ++next;
        }
        for (const auto& [wanted, at] : {std::pair(symbol, next), std::pair(behind && i > 0, i - 1)}) {
            if (wanted && at < pieces.size() && pieces[at].kind == Piece::Kind::number && !pieces[at].percent &&
                pieces[at].value > 0.0) {
                return pieces[at].value;
            }
        }
    }
    return std::nullopt;
}

/// The only number behind the name of the distribution t: 9 of "t (9)", "t, 9", "Student's t (9)". None that is said to be something
/// else, as in "t (k = 3)" or "t (95 %)".
std::optional<double> number_behind_t(const Pieces& pieces) {
    std::optional<double> only;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (!piece.is_number()) {
            const bool is_name = piece.kind == Piece::Kind::sign || piece.raw == "t" || piece.raw == "s" ||
                                 piece.begins("student") || piece.begins("distrib") || piece.begins("verteil");
            if (!is_name || piece.is_sign("=")) {
                return std::nullopt;
            }
            continue;
        }
        if (only || i == 0 || piece.percent || piece.plus_minus || !piece.unit.empty()) {
            return std::nullopt;
        }
        only = piece.value;
    }
    return only;
}

/// Whether a number may be what an expanded uncertainty is divided by: the divisor of the row, U over u, or k of a certificate, at
/// most rounded to whole ones.
bool may_be_divisor(double number, const AuditedRow& row) {
    constexpr double k_half = 0.5;
    const auto is_it = [number](double divisor) { return std::abs(divisor - number) < k_half; };
    return (row.divisor && is_it(row.divisor->value)) || (row.certificate_k && is_it(*row.certificate_k)) ||
           (row.stated && row.u && row.u->value > 0.0 && is_it(row.stated->value / row.u->value));
}

/// Degrees of freedom in the words of the distribution t: "t, ν = 9", "t (9)". A number by itself may be a factor, "t (3)" beside
/// the divisor 3, or a probability, "t (95)": neither is read, and a small one of readings only, of which it is n − 1.
std::optional<double> degrees_of_freedom_of_t(const AuditedRow& row) {
    const Pieces pieces = pieces_of(row.shape_text, row.decimal_sign);
    if (const std::optional<double> nu = degrees_of_freedom(pieces)) {
        return nu;
    }
    constexpr double k_fewest = 3.0, k_no_factor = 5.0, k_most = 1e6;
    constexpr std::array k_percent{68.0, 90.0, 95.0, 98.0, 99.0};
    const std::optional<double> nu = number_behind_t(pieces);
    const bool is_count = nu && *nu >= k_fewest && *nu <= k_most && *nu == std::floor(*nu) &&
                          std::find(k_percent.begin(), k_percent.end(), *nu) == k_percent.end();
    const bool is_of_readings = row.type_a.value_or(row.contributor == Contributor::repeatability ||
                                                    row.contributor == Contributor::reproducibility);
    return is_count && (*nu >= k_no_factor || is_of_readings) && !may_be_divisor(*nu, row) ? nu : std::nullopt;
}

/// "pooled s = 0.12 µm".
std::optional<double> pooled_deviation(const Pieces& pieces, const AuditedRow& row) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!pieces[i].begins("pool") && !pieces[i].begins("gepool")) {
            continue;
        }
        for (std::size_t j = i + 1; j < pieces.size() && !ends_sentence(pieces[j]); ++j) {
            if (pieces[j].kind == Piece::Kind::number) {
                const std::optional<NumberOfRow> number = in_unit_of_row(pieces[j], row);
                const bool of_s = j >= 2 && pieces[j - 1].is_sign("=") && pieces[j - 2].raw == "s";
                if (number && (number->has_unit || of_s)) {
                    return number->value;
                }
            }
        }
    }
    return std::nullopt;
}

/// "standard deviation 0.12 µm" of single readings; nothing for that of their mean, nor for one that is pooled.
std::optional<double> deviation_of_readings(const Pieces& pieces, const AuditedRow& row) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool two_words =
            pieces[i].word == "standard" && i + 1 < pieces.size() && pieces[i + 1].begins("deviation");
        const bool symbol = pieces[i].raw == "s" && i + 1 < pieces.size() && pieces[i + 1].is_sign("=");
        if (!two_words && !symbol && !pieces[i].begins("standardabweich")) {
            continue;
        }
        std::size_t next = i + (two_words ? 2 : 1);
        while (next < pieces.size() && is_filler(pieces[next])) {
            ++next;
        }
        if (next < pieces.size() && pieces[next].kind == Piece::Kind::number) {
            const std::optional<NumberOfRow> number = in_unit_of_row(pieces[next], row);
            if (number && (number->has_unit || symbol)) {
                return number->value;
            }
        }
    }
    return std::nullopt;
}

/// "±1 K", or "±0.5" without a unit.
std::optional<double> plus_minus(const Pieces& pieces, const AuditedRow& row) {
    for (const Piece& piece : pieces) {
        if (piece.kind == Piece::Kind::number && piece.plus_minus) {
            if (const std::optional<NumberOfRow> number = in_unit_of_row(piece, row)) {
                return number->value;
            }
        }
    }
    return std::nullopt;
}

/// What one text says of the origin; `not_stated` where it says nothing.
struct Reading {
    Origin origin = Origin::not_stated;
    std::optional<double> value;
};

Reading origin_in(const Pieces& pieces, const AuditedRow& row) {
    if (const std::optional<ExpandedInWords> U = expanded_uncertainty_in(pieces, row)) {
        return {.origin = Origin::certificate, .value = U->value};
    }
    const std::array<std::pair<Origin, Found>, 5> candidates{{
        {Origin::specification, find_keyword(pieces, k_of_specification, row)},
        {Origin::resolution, find_keyword(pieces, k_of_resolution, row)},
        {Origin::readings,
         {.value = {}, .said = find_keyword(pieces, k_of_readings, row).said || count_of_readings(pieces).has_value()}},
        {Origin::certificate, find_keyword(pieces, k_of_certificate, row)},
        {Origin::limits, find_keyword(pieces, k_of_limits, row)},
    }};
    // A keyword with its number says more than one without, whichever comes first in the text.
    for (const auto& [origin, found] : candidates) {
        if (found.value) {
            return {origin, found.value};
        }
    }
    for (const auto& [origin, found] : candidates) {
        if (found.said) {
            return {origin, origin == Origin::specification || origin == Origin::limits ? plus_minus(pieces, row)
                                                                                        : std::nullopt};
        }
    }
    if (const std::optional<double> half_width = plus_minus(pieces, row)) {
        return {Origin::limits, half_width};
    }
    return {};
}

/// The number of an origin that is known already.
std::optional<double> value_in(const Pieces& pieces, Origin origin, const AuditedRow& row) {
    const auto either = [](std::optional<double> first, std::optional<double> second) {
        return first ? first : second;
    };
    switch (origin) {
        case Origin::certificate:
            if (const std::optional<ExpandedInWords> U = expanded_uncertainty_in(pieces, row)) {
                return U->value;
            }
            // Where words state a U that is left open, none of the other numbers is it.
            return row.open_expansion ? std::nullopt : find_keyword(pieces, k_of_certificate, row).value;
        case Origin::specification:
            return either(find_keyword(pieces, k_of_specification, row).value, plus_minus(pieces, row));
        case Origin::resolution:
            return find_keyword(pieces, k_of_resolution, row).value;
        case Origin::limits:
            return either(find_keyword(pieces, k_of_limits, row).value, plus_minus(pieces, row));
        case Origin::readings:
        case Origin::not_stated:
            break;
    }
    return std::nullopt;
}

/// The only number with a unit of the row's kind; nothing where there are several.
std::optional<double> only_number(const Pieces& pieces, const AuditedRow& row) {
    std::optional<double> only;
    for (const Piece& piece : pieces) {
        if (piece.kind != Piece::Kind::number) {
            continue;
        }
        const std::optional<NumberOfRow> number = in_unit_of_row(piece, row);
        if (number && number->has_unit) {
            if (only) {
                return std::nullopt;
            }
            only = number->value;
        }
    }
    return only;
}

bool begins_any(const Piece& piece, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&piece](std::string_view beginning) { return piece.begins(beginning); });
}

/// The next piece that is no article and no sign: "digit" behind "half" of "half of the last digit"; nullptr at the end.
const Piece* next_noun(const Pieces& pieces, std::size_t place) {
    constexpr std::array<std::string_view, 19> k_between{
        "of",  "the", "a",   "an",   "der",   "des",      "eines",     "einer",   "de", "la",
        "del", "du",  "von", "last", "least", "smallest", "kleinsten", "letzten", "x"};
    for (std::size_t i = place + 1; i < pieces.size(); ++i) {
        const bool is_between = pieces[i].kind == Piece::Kind::sign
                                    ? !ends_sentence(pieces[i]) && !pieces[i].is_sign(",") && !pieces[i].is_sign(":")
                                    : std::find(k_between.begin(), k_between.end(), pieces[i].word) != k_between.end();
        if (!is_between) {
            return &pieces[i];
        }
    }
    return nullptr;
}
bool names_step(const Piece* noun) {
    return noun != nullptr && (noun->word == "d" ||
                               begins_any(*noun, {"digit", "ziffer", "step", "schritt", "lsd", "lsb", "count", "resol",
                                                  "auflos", "aufloes", "division", "skalenteil", "teilung", "interval",
                                                  "increment", "inkrement", "graduation", "paso", "escalon"}));
}

/// Whether a word says that what it stands beside is half of a step. "Half load", "Halblast" and "semiconductor" are of
/// something else, and the half of "4½ digits" is part of a count.
bool says_half(const Pieces& pieces, std::size_t place) {
    const Piece& piece = pieces[place];
    if (piece.kind != Piece::Kind::word) {
        return false;
    }
    if (piece.raw.starts_with("½")) {
        return place == 0 || !pieces[place - 1].is_number();
    }
    const Piece* noun = next_noun(pieces, place);
    const bool is_condition = place > 0 && pieces[place - 1].kind == Piece::Kind::word &&
                              (pieces[place - 1].word == "at" || pieces[place - 1].word == "bei" ||
                               pieces[place - 1].word == "im" || pieces[place - 1].word == "in");
    if (is_condition) {
        return false;
    }
    const auto is_width = [](std::string_view word) {
        for (const std::string_view width : {"range", "width", "span", "ancho", "amplit", "interv", "etendue",
                                             "largeur", "weite", "breite", "schritt", "ziffer", "digit"}) {
            if (word.starts_with(width)) {
                return true;
            }
        }
        return false;
    };
    if (piece.word == "media" || piece.word == "medio") {
        return names_step(noun);
    }
    for (const std::string_view part : {"semi", "demi"}) {
        if (piece.begins(part)) {
            const std::string_view rest = std::string_view(piece.word).substr(part.size());
            return rest.empty() ? names_step(noun) || (noun != nullptr && is_width(noun->word)) : is_width(rest);
        }
    }
    for (const std::string_view part : {"half", "halb"}) {
        if (piece.begins(part)) {
            const std::string_view rest = std::string_view(piece.word).substr(part.size());
            const bool is_alone =
                rest.empty() || rest == "e" || rest == "er" || rest == "en" || rest == "es" || rest == "em";
            return is_alone ? noun == nullptr ||
                                  !begins_any(*noun, {"load", "full", "scale", "hour", "year", "day", "month", "speed",
                                                      "bridge", "wave", "capacity", "skala", "stunde", "jahr", "bruck"})
                            : is_width(rest);
        }
    }
    return false;
}

/// What words say that a number in them is: the step of a display, half of it, or a bound of so many steps.
enum class SaidOfStep { whole, half, bound };

/// "half of the digit: 50 mV", "Resolution/2 = 50 mV", "± 50 mV", "50 mV (half of 100 mV)" are half; "±1 digit = 50 mV" is a bound.
SaidOfStep said_of_step(const Pieces& pieces, const AuditedRow& row, double number) {
    constexpr double k_half = 0.5, k_same = 1e-9, k_few_digits = 2.0;
    const auto is_number = [&](const Piece& piece, double wanted) {
        const std::optional<NumberOfRow> held =
            piece.is_number() ? in_unit_of_row(piece, row) : std::optional<NumberOfRow>();
        return held && std::abs(held->value - wanted) <= k_same * wanted;
    };
    // "Resolution/2" and "1/2 digit", and not "4 1/2 digits", "channel 1/2".
    const auto is_over_two = [&pieces](std::size_t j) {
        if (pieces[j].value != 2.0 || j == 0 || !pieces[j - 1].is_sign("/")) {
            return false;
        }
        if (j < 2 || !pieces[j - 2].is_number()) {
            return true;
        }
        return pieces[j - 2].value == 1.0 && (j < 3 || !pieces[j - 3].is_number()) && names_step(next_noun(pieces, j));
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!is_number(pieces[i], number)) {
            continue;
        }
        if (pieces[i].plus_minus) {
            return SaidOfStep::half;
        }
        for (std::size_t j = i; j-- > 0 && !ends_sentence(pieces[j]);) {
            const bool is_half_number =
                pieces[j].is_number() && pieces[j].value == k_half && names_step(next_noun(pieces, j));
            if (says_half(pieces, j) || is_half_number || (pieces[j].is_number() && is_over_two(j))) {
                return SaidOfStep::half;
            }
            // Six digits are those of a display, and no bound.
            if (pieces[j].is_number() && j + 1 < i && (pieces[j].plus_minus || pieces[j].value <= k_few_digits) &&
                begins_any(pieces[j + 1], {"digit", "ziffer", "count", "lsd"})) {
                return SaidOfStep::bound;
            }
            const std::optional<NumberOfRow> other =
                pieces[j].is_number() ? in_unit_of_row(pieces[j], row) : std::optional<NumberOfRow>();
            if (other && other->has_unit) {
                break;  // "100 mV, half: 50 mV" begins with what it is half of
            }
        }
        bool is_half = false;
        for (std::size_t j = i + 1; j < pieces.size() && !ends_sentence(pieces[j]); ++j) {
            if (is_half && is_number(pieces[j], 2.0 * number)) {
                return SaidOfStep::half;
            }
            is_half = is_half || says_half(pieces, j);
        }
    }
    return SaidOfStep::whole;
}

/// The step of a resolution whose words state a number X. Where they say that it is half of the step, the step is 2 X; "half of the
/// resolution 50 mV" may be half of 50 mV, too: then the columns tell, which hold 25 mV, or a u of 50 mV/√12, as they state it, divide
/// it, or multiply it by c.
double step_in_words(const AuditedRow& row, std::span<const Pieces> texts, double X) {
    SaidOfStep said = SaidOfStep::whole;
    for (const Pieces& pieces : texts) {
        said = said == SaidOfStep::whole ? said_of_step(pieces, row, X) : said;
    }
    const auto is_part = [X](double number, double part) {
        constexpr double k_digits = 0.02;
        return std::abs(std::abs(number) - part * X) <= k_digits * part * X;
    };
    const auto u_is = [&](double part) {
        const double c = row.sensitivity ? row.sensitivity->value : 1.0;
        return (row.u && is_part(row.u->value, part)) ||
               (row.stated && row.divisor && row.divisor->value > 0.0 &&
                is_part(row.stated->value / row.divisor->value, part)) ||
               (row.contribution && c != 0.0 && is_part(row.contribution->value / c, part));
    };
    const bool is_of_X = u_is(1.0 / std::sqrt(12.0)) || (row.stated && is_part(row.stated->value, 0.5)) ||
                         (!row.stated && row.u && is_part(row.u->value, 0.5)) ||
                         (said == SaidOfStep::bound && u_is(2.0 / std::sqrt(3.0)));
    return said != SaidOfStep::whole && !is_of_X ? 2.0 * X : X;
}

/// Distributions that a sentence names; "normal" alone is a measurement standard in German.
Shape shape_in_sentence(const WordLine& words) {
    if (words.has_any({"rect ", "rectang", "rechteck", "*gleichverteil", "uniform distribut", "uniformly"})) {
        return Shape::rectangular;
    }
    if (words.has_any({"triang", "dreieck"})) {
        return Shape::triangular;
    }
    if (words.has_any({"arcsin", "arkussin", "arcussin", "u shaped", "u distribut", "u formig", "u verteil"})) {
        return Shape::arcsine;
    }
    if (words.has_any({"trapez"})) {
        return Shape::trapezoidal;
    }
    if (words.has_any({"student", "t distribut", "t verteil"})) {
        return Shape::student_t;
    }
    if (words.has_any({"normal distribut", "normalverteil", "normally distribut", "gauss"})) {
        return Shape::normal;
    }
    return Shape::not_stated;
}

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos
               ? std::string()
               : std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

StatedNumber quotient(const StatedNumber& a, const StatedNumber& b) {
    StatedNumber result;
    result.value = a.value / b.value;
    // To first order, all in the worst direction: a bound of what the digits leave open, not an uncertainty.
    result.half_step = std::abs(a.half_step / b.value) + std::abs(result.value / b.value) * b.half_step;
    return result;
}
StatedNumber product(const StatedNumber& a, const StatedNumber& b) {
    StatedNumber result;
    result.value = a.value * b.value;
    result.half_step = std::abs(a.value) * b.half_step + std::abs(b.value) * a.half_step + a.half_step * b.half_step;
    return result;
}
/// Whether two numbers are the same within what their digits leave open.
bool agree(const StatedNumber& a, const StatedNumber& b) {
    constexpr double k_rounding = 1e-6;  // of exact numbers that somebody computed
    const double open = a.half_step + b.half_step + k_rounding * std::max(std::abs(a.value), std::abs(b.value));
    return std::abs(std::abs(a.value) - std::abs(b.value)) <= open;
}

bool is_usable(const std::optional<StatedNumber>& number) {
    return number && std::isfinite(number->value);
}
bool is_divisor(const std::optional<StatedNumber>& number) {
    return is_usable(number) && number->value > 0.0;
}

Contributor contributor_by_words(std::string_view quantity, std::string_view comment, std::string_view source) {
    const WordLine words_of_quantity(quantity);
    if (const Contributor kind = kind_of_effect(words_of_quantity, quantity); kind != Contributor::other) {
        return kind;
    }
    const Contributor device = device_of(words_of_quantity);
    // A comment on a standard names many things; what it begins with is what the row is.
    const WordLine beginning(comment.substr(0, comment.find_first_of(",;:(")));
    if (device != Contributor::other) {
        const Contributor kind = kind_of_effect(beginning, comment.substr(0, 0));
        if (kind == Contributor::reference_drift || kind == Contributor::item_resolution ||
            kind == Contributor::reference_resolution || kind == Contributor::repeatability) {
            if (kind == Contributor::item_resolution && device == Contributor::reference) {
                return Contributor::reference_resolution;
            }
            return kind == Contributor::reference_drift && device == Contributor::item ? Contributor::item : kind;
        }
        return device;
    }
    for (const std::string_view text : {comment, source}) {
        const WordLine words(text);
        for (const Contributor found : {kind_of_effect(words, text), device_of(words)}) {
            if (found != Contributor::other) {
                return found;
            }
        }
    }
    return Contributor::other;
}

}  // namespace

Contributor contributor_of(std::string_view quantity, std::string_view comment, std::string_view source) {
    // The budgets of a certificate have the same rows from point to point, and to read one takes as long as to render it.
    static thread_local std::map<std::array<std::string, 3>, Contributor> known;
    constexpr std::size_t k_most = 1024;
    std::array<std::string, 3> row{std::string(quantity), std::string(comment), std::string(source)};
    if (const auto found = known.find(row); found != known.end()) {
        return found->second;
    }
    const Contributor contributor = contributor_by_words(quantity, comment, source);
    if (known.size() == k_most) {
        known.clear();
    }
    known.emplace(std::move(row), contributor);
    return contributor;
}

std::optional<double> divisor_of_shape(Shape shape) {
    switch (shape) {
        case Shape::rectangular:
            return std::numbers::sqrt3;
        case Shape::triangular:
            return std::sqrt(6.0);
        case Shape::arcsine:
            return std::numbers::sqrt2;
        default:
            return std::nullopt;
    }
}

Shape shape_of(std::string_view text) {
    const std::string raw = trimmed(cut(text, k_longest_text));
    const WordLine words(raw);
    const bool empty = certificate::words_of(raw).empty();
    if (empty) {
        return Shape::not_stated;
    }
    if (const Shape shape = shape_in_sentence(words); shape != Shape::not_stated) {
        return shape;
    }
    if (words.has_any({"rec ", "uniform", "gleich", "square", "recht", "*矩形", "*均勻", "*均匀"})) {
        return Shape::rectangular;
    }
    // "t (9)" and "t, ν = 9" are "t"; "T" may be of a triangle.
    const bool is_t = raw == "t" || (raw.size() > 1 && raw[0] == 't' &&
                                     std::string_view(" (,;_").find(raw[1]) != std::string_view::npos);
    if (is_t || words.has_any({"t faktor", "t factor"})) {
        return Shape::student_t;
    }
    if (words.has_any({"lognorm", "log norm"})) {
        return Shape::other;
    }
    if (words.has_any({"normal", "norm ", "gaus", "n ", "*常態", "*正態", "*正态"})) {
        return Shape::normal;
    }
    if (words.has_any({"tri ", "dreieck", "*三角"})) {
        return Shape::triangular;
    }
    if (words.has_any({"r "})) {  // as "N" beside it
        return Shape::rectangular;
    }
    if (words.has_any({"u form", "ushape", "cyclic", "sinus"})) {
        return Shape::arcsine;
    }
    return Shape::other;
}

std::string name_in_words(const AuditedRow& row) {
    return row.description.empty() ? row.quantity : row.quantity + "; " + row.description;
}

void read_comment(AuditedRow& row) {
    const std::array<Pieces, 3> texts{pieces_of(row.comment, row.decimal_sign),
                                      pieces_of(name_in_words(row), row.decimal_sign),
                                      pieces_of(row.source, row.decimal_sign)};
    if (row.type_a == true && row.origin == Origin::not_stated) {
        row.origin = Origin::readings;
    }
    if (row.origin == Origin::not_stated) {
        for (const Pieces& pieces : texts) {
            const Reading reading = origin_in(pieces, row);
            if (reading.origin != Origin::not_stated) {
                row.origin = reading.origin;
                row.origin_value = row.origin_value ? row.origin_value : reading.value;
                break;
            }
        }
    }
    for (std::size_t i = 0; i < texts.size() && row.origin == Origin::certificate && !row.open_expansion; ++i) {
        const std::optional<ExpandedInWords> U = expanded_uncertainty_in(texts[i], row);
        row.open_expansion = U && !U->value ? std::optional(U->open) : std::nullopt;
    }
    for (std::size_t i = 0; i < texts.size() && !row.origin_value; ++i) {
        row.origin_value = value_in(texts[i], row.origin, row);
    }
    const bool one_number = row.origin == Origin::resolution || row.origin == Origin::specification;
    if (!row.origin_value && one_number) {
        row.origin_value = only_number(texts.front(), row);
    }
    if (row.origin == Origin::certificate) {
        for (const Pieces& pieces : texts) {
            row.certificate_k = row.certificate_k ? row.certificate_k : coverage_factor(pieces);
            row.certificate_probability =
                row.certificate_probability ? row.certificate_probability : coverage_probability(pieces);
        }
    }
    if (row.origin == Origin::readings) {
        for (const Pieces& pieces : texts) {
            row.n = row.n ? row.n : count_of_readings(pieces);
            row.pooled_s = row.pooled_s ? row.pooled_s : pooled_deviation(pieces, row);
            row.origin_value = row.origin_value ? row.origin_value : deviation_of_readings(pieces, row);
        }
    }
    if ((row.origin == Origin::specification || row.origin == Origin::limits) && row.origin_value) {
        for (const Pieces& pieces : texts) {  // "tolerance band 0.60 mV (±0.30 mV)"
            const std::optional<double> half_width = plus_minus(pieces, row);
            const bool is_half = half_width && std::abs(*row.origin_value - 2.0 * *half_width) <= 1e-9 * *half_width;
            row.origin_value = is_half ? half_width : row.origin_value;
        }
    }
    if (row.origin == Origin::resolution && row.origin_value) {
        row.origin_value = step_in_words(row, texts, *row.origin_value);
    }
    if (row.origin_value && !(*row.origin_value > 0.0 && std::isfinite(*row.origin_value))) {
        row.origin_value.reset();  // "U = 0" says nothing of a size
    }
    if (!row.nu) {
        if (const std::optional<double> nu = degrees_of_freedom(texts.front())) {
            row.nu = exact_number(*nu, row.place);
        }
    }
    if (!row.type_a && row.origin != Origin::not_stated) {
        row.type_a = row.origin == Origin::readings;
    }
    if (row.shape == Shape::not_stated) {
        row.shape = shape_in_sentence(WordLine(row.comment));
    }
    if (row.contributor == Contributor::other) {
        row.contributor = contributor_of(name_in_words(row), row.comment, row.source);
    }
    // Readings whose words say nothing else scatter as the instrument and the item do.
    if (row.contributor == Contributor::other && row.type_a == true) {
        row.contributor = Contributor::repeatability;
    }
    if (!row.nu && row.shape == Shape::student_t) {
        if (const std::optional<double> nu = degrees_of_freedom_of_t(row)) {
            row.nu = exact_number(*nu, row.place);
        }
    }
}

void complete_row(AuditedRow& row) {
    const bool has_divisor = is_divisor(row.divisor);
    const std::optional<StatedNumber> c = is_usable(row.sensitivity) ? row.sensitivity : std::nullopt;
    const StatedNumber factor = c.value_or(exact_number(1.0, ""));
    // A column of uncertainties in which the divisor is still to come.
    if (is_usable(row.u) && !row.stated && has_divisor && is_usable(row.contribution)) {
        const bool divided = agree(product(factor, *row.u), *row.contribution);
        const bool undivided = agree(product(factor, quotient(*row.u, *row.divisor)), *row.contribution);
        // The contribution is what the sum was made of, so it tells whether a divisor has acted already. Where both
        // readings fit, the head of the column is believed.
        if (undivided && !divided) {
            row.stated = std::exchange(row.u, std::nullopt);
        }
    }
    std::optional<StatedNumber> u;
    if (is_usable(row.u)) {
        u = row.u;
    } else if (is_usable(row.stated) && has_divisor) {
        u = quotient(*row.stated, *row.divisor);
    } else if (is_usable(row.contribution) && factor.value != 0.0) {
        u = quotient(*row.contribution, factor);
    } else if (is_usable(row.stated)) {
        const std::optional<double> implied =
            row.origin == Origin::certificate && row.certificate_k ? row.certificate_k : divisor_of_shape(row.shape);
        u = quotient(*row.stated, exact_number(implied.value_or(1.0), ""));
    }
    // A quotient beyond all numbers is none.
    if (u && (!std::isfinite(u->value) || !std::isfinite(u->half_step))) {
        u.reset();
    }
    StatedNumber sensitivity = factor;
    if (!c && u && u->value != 0.0 && is_usable(row.contribution) && !agree(*u, *row.contribution)) {
        const StatedNumber implied = quotient(*row.contribution, *u);
        sensitivity = std::isfinite(implied.value) && std::isfinite(implied.half_step) ? implied : factor;
    }
    row.used_u = u ? std::abs(u->value) : 0.0;
    row.u_half_step = u ? std::abs(u->half_step) : 0.0;
    row.used_sensitivity = sensitivity.value;
    row.sensitivity_half_step = sensitivity.half_step;
    const bool finite = row.nu && std::isfinite(row.nu->value) && row.nu->value > 0.0;
    row.used_nu = finite ? row.nu->value : std::numeric_limits<double>::infinity();
    settle_expanded_uncertainty(row);
}

std::optional<StatedNumber> quotient_of_columns(const AuditedRow& row) {
    if (!is_usable(row.stated) || !is_divisor(row.divisor) || row.stated->value == 0.0 || row.relative_uncertainty ||
        row.lower_limit || row.upper_limit) {
        return std::nullopt;
    }
    const auto is_percent = [](const std::optional<StatedNumber>& number) {
        return number && number->text.find('%') != std::string::npos;
    };
    if (is_percent(row.stated) != is_percent(row.u)) {
        return std::nullopt;  // a part of a base that no column names
    }
    StatedNumber of = quotient(*row.stated, *row.divisor);
    of.value = std::abs(of.value);
    return std::isfinite(of.value) && std::isfinite(of.half_step) && of.value > 0.0 ? std::optional(of) : std::nullopt;
}

bool u_is_not_the_quotient(const AuditedRow& row) {
    constexpr double k_beyond_digits = 0.01;
    const std::optional<StatedNumber> of = is_usable(row.u) ? quotient_of_columns(row) : std::nullopt;
    return of && std::abs(std::abs(row.u->value) - of->value) >
                     row.u->half_step + of->half_step + k_beyond_digits * of->value;
}

void use_quotient_of_columns(AuditedRow& row) {
    const std::optional<StatedNumber> of = quotient_of_columns(row);
    if (!of) {
        return;
    }
    row.used_u = of->value;
    row.u_half_step = of->half_step;
    if (is_usable(row.sensitivity)) {
        row.used_sensitivity = row.sensitivity->value;
        row.sensitivity_half_step = row.sensitivity->half_step;
    }
    if (is_usable(row.contribution) &&
        !agree(product(exact_number(row.used_sensitivity, ""), *of), *row.contribution)) {
        row.contribution.reset();
    }
}

namespace {

/// The u that a row states, or, in a table without such a column, what it divides over its divisor.
std::optional<StatedNumber> u_of_columns(const AuditedRow& row) {
    return is_usable(row.u) ? row.u : quotient_of_columns(row);
}

}  // namespace

void settle_contributions(AuditedBudget& budget) {
    constexpr double k_beyond_digits = 0.01;
    std::vector<AuditedRow*> other;
    std::size_t columns = 0;
    for (AuditedRow& row : budget.rows) {
        const std::optional<StatedNumber> u = u_of_columns(row);
        if (!is_usable(row.sensitivity) || !u || !is_usable(row.contribution)) {
            continue;
        }
        ++columns;
        StatedNumber own = product(*row.sensitivity, *u);
        own.half_step += k_beyond_digits * std::abs(own.value);
        if (agree(own, *row.contribution)) {
            continue;
        }
        if (u_is_not_the_quotient(row) &&
            agree(product(*row.sensitivity, *quotient_of_columns(row)), *row.contribution)) {
            use_quotient_of_columns(row);
        } else {
            other.push_back(&row);
        }
    }
    constexpr std::size_t k_few = 3;  // no more than every third row
    // A slip is in few rows. A column that differs in most rows holds something else, such as shares in percent.
    const bool is_error = other.size() * k_few <= columns;
    for (AuditedRow* row : other) {
        if (!is_error) {
            row->contribution.reset();
        } else if (row->used_u > 0.0) {
            const StatedNumber implied = quotient(*row->contribution, *u_of_columns(*row));
            row->used_sensitivity = std::copysign(implied.value, row->sensitivity->value);
            row->sensitivity_half_step = implied.half_step;
        }
    }
}

}  // namespace gumcert::audit
