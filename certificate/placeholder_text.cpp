#include "certificate/placeholder_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "certificate/text_words.h"

namespace gumcert::certificate {

namespace {

/// Words with blanks between them.
class WordList {
public:
    explicit WordList(std::u32string_view literal) {
        for (std::size_t begin = literal.find_first_not_of(U' '); begin != literal.npos;) {
            const std::size_t end = std::min(literal.find(U' ', begin), literal.size());
            words_.insert(literal.substr(begin, end - begin));
            begin = literal.find_first_not_of(U' ', end);
        }
    }
    [[nodiscard]] bool has(const std::u32string& word) const { return words_.contains(word); }

private:
    std::unordered_set<std::u32string_view> words_;  // they point into the literal
};

/// Words that say that there is nothing, or that it stands elsewhere, or that somebody tried a form out. Small letters,
/// without accents.
const WordList k_nothing(  // English
    U" unknown unkown unknow unnamed unidentified unspecified undefined undetermined undisclosed unstated unrecorded "
    U"unassigned unavailable none nothing nil null so sa nan void empty blank missing nn absent na nd ns tbd tba tbc "
    U"tbs tbn "
    U"todo "
    U"fixme pending later soon open applicable available specified stated given provided known recorded reported "
    U"supplied disclosed identified defined determined assigned decided announced confirmed added filled required "
    U"relevant needed necessary applied present here there above below attached attachment previous previously before "
    U"ditto idem same dito nobody noone someone somebody anyone anybody something anything whatever whoever any some "
    U"various several misc miscellaneous anonymous anon confidential secret private redacted removed deleted hidden "
    U"omitted withheld test testing tests tester demo dummy fake mock placeholder filler foo bar baz foobar qux quux "
    U"idea who knows please fill insert enter known unknowable nowhere somewhere moved invoice internet planet earth "
    U"order "
    U"cover letter page copy refer per as before checked inspected examined looked received receipt internal walkin "
    U"temp tmp changeme default qwe asd nk tbf doe us yours stamped legible illegible readable unreadable found today "
    U"lorem ipsum dolor sit amet asdf asdfg asdfgh asdfghjkl sdf jkl hjkl qwerty qwert qwertz azerty yxcv zxcv abc "
    U"abcd "
    U"abcde xyz bla blah blub blabla blahblah yada etc false true undefined error ref nr no yes yep nope "
    // German
    U"unbekannt unbekannte unbekannter unbekanntes unbenannt ungenannt keine keiner keines kein nichts fehlt fehlend "
    U"entfallt entfaellt nv ka kd noch offen folgt spater spaeter siehe oben unten ohne anlage anhang beilage "
    U"beigefugt "
    U"wie zuvor gleich dasselbe angabe angaben anwendbar zutreffend verfugbar verfuegbar bekannt angegeben "
    U"vorhanden festgelegt benannt erfasst jemand niemand irgendwer irgendwas irgendetwas diverse verschiedene anonym "
    U"vertraulich geheim probe platzhalter muster leer ja nein genannt ungenannter nachgereicht nachzureichen "
    U"nachreichen "
    U"bitte ausfullen ausfuellen auszufullen eintragen erganzt ergaenzt kommt mustermann musterfirma musterstrasse "
    U"musterstadt musterhausen musterort intern hausintern barkunde privatperson namenlos namen auftrag laut gemass "
    U"gemaess anfrage rechnung verzogen gepruft geprueft prufung pruefung kontrolliert erhalten eingegangen "
    U"unleserlich "
    U"lesbar heute morgen irgendwo nirgendwo "
    // Spanish
    U"desconocido desconocida desconocidos desconocidas ninguno ninguna ningun nada nadie vacio vacia falta faltante "
    U"pendiente aplica aplicable disponible especificado especificada especificar indicar indicado indicada conocido "
    U"conocida "
    U"proporcionado definido definida determinar definir confirmar consta datos dato sd vease ver arriba abajo adjunto "
    U"anexo anterior idem mismo misma alguien algo cualquiera varios varias anonimo anonima confidencial secreto "
    U"prueba pruebas si sin blanco rellenar completar ilegible legible conoce sabe pedido solicitud factura "
    U"inspeccionado inspeccionada revisado revisada recibido recibida fulano interno hoy manana "
    // French, Italian: what is filled in by neighbours
    U"neant inconnu inconnue sconosciuto sconosciuta ");
/// Words that do not change that: articles, particles.
const WordList k_particles(
    U" a an the of to be is are was were it its in on at for from by with and or as not see this that yet still been "
    U"will our my your their his her all "
    U"der die das des dem den ein eine einer und oder von zu zur zum im am mit ist sind wird werden nicht noch als fur "
    U"fuer nach "
    U"auf an bei vom es gab war waren wurde wurden ihr ihre unser unsere "
    U"el la los las un una de del en por para con es son no se lo al como hubo tal su "
    U"only on request here up out to ltd inc llc corp co gmbh ag kg sl srl mr mrs ms herr frau senor senora ");
/// Names of fields, which tell nothing of their own.
const WordList k_fields(
    U" customer client name names address street city town country number serial serialnumber sn id identification "
    U"item object device thing instrument unit dut uut laboratory lab method procedure standard certificate "
    U"issuer body person manufacturer text string value field reason description condition deviation remark "
    U"information info data details detail document version edition agreement contract "
    U"kunde auftraggeber adresse anschrift strasse ort land nummer seriennummer gegenstand ding gerat geraet labor "
    U"laboratorium verfahren methode zertifikat schein aussteller stelle wert feld grund beschreibung "
    U"zustand abweichung bemerkung dokument vertrag "
    U"cliente nombre direccion calle ciudad pais numero serie objeto cosa equipo instrumento laboratorio metodo "
    U"procedimiento patron certificado emisor texto valor campo motivo descripcion estado desviacion observacion "
    U"informacion documento contrato site premises plant factory office facility house home werk halle planta "
    U"instalaciones company firma empresa deviations conditions remarks abweichungen bemerkungen "
    U"desviaciones particular page seite pagina folder ordner procedures ");
/// Words of these that people and firms are called, too.
const WordList k_also_names(
    U" feld field land ort grund werk halle hall house home page folder office plant stelle schein mock leer present "
    U"open planet earth testing tester noch gleich found moved cover order dolor campo blanco interno calle ");
const WordList k_legal_forms(U" ltd limited inc llc corp co plc gmbh ag kg ohg ug sl srl slu sas bv nv oy ab as spa ");
/// Whole texts that look like names and are those of nobody.
const WordList k_of_nobody(
    U" johndoe janedoe maxmustermann erikamustermann acme sample example beispiel ejemplo privateperson walkincustomer "
    U"commonpractice fulanodetal 例 "
    U"範例 "
    U"范例 ");
/// Words of a sentence that tell nothing by themselves.
const WordList k_talk(
    U" we i you he she they do did does done want wants say says said care thing things way ways different differently "
    U"because reason boss letter separate separately follow follows following describe described later else there were "
    U"was have has had must may can could would should only just also very much more most other others "
    U"wir ich sie weil wollen will sagen gesagt sache sachen anders art weise folgen brief gesondert beschrieben "
    U"auch sehr mehr andere anderen habe haben hatte kann konnen soll sollen mussen "
    U"nosotros porque queremos quiere decir dicho cosa cosas manera forma otra otro siguiente carta aparte descrito "
    U"tambien muy mas puede debe ");
/// Verbs that tell nothing without another word.
const WordList k_auxiliaries(
    U" is are was were has had did does be been ist sind war waren wurde wurden hat hatte es era eran fue fueron esta "
    U"estan "
    U"estaba estaban ha habia ");
/// Verbs of short sentences about a thing or a person.
const WordList k_verbs(
    U" accepts accepted agrees agreed declines declined refuses refused rejects rejected requests requested asks asked "
    U"wants wanted keeps kept needs needed failed broke stopped leaks leaked arrived came "
    U"akzeptiert akzeptierte verlangt verlangte wunscht wunschte wuenscht lehnt lehnte fiel kam bleibt blieb "
    U"acepta acepto solicita solicito pide pidio rechaza rechazo fallo llego llegaron queda quedo ");
/// That something is agreed on, without who did or why.
const WordList k_consent(
    U" agreed accepted approved permitted allowed confirmed vereinbart akzeptiert genehmigt abgestimmt erlaubt "
    U"zugelassen bestatigt acordado acordada aceptado aceptada aprobado aprobada permitido permitida confirmado ");
/// What may be agreed on. Whoever else stands before "agreed" is the one who agreed: "Laborleiter genehmigt".
const WordList k_agreed_things(
    U" divisor value values limit limits tolerance method procedure uncertainty budget deviation exception omission "
    U"change waiver it this that all everything factor coverage scope range result results number distribution "
    U"teiler wert werte grenze grenzwert grenzwerte toleranz methode verfahren unsicherheit abweichung ausnahme "
    U"weglassung anderung verzicht dies das alles faktor umfang bereich ergebnis ergebnisse verteilung "
    U"valor valores limite limites tolerancia metodo procedimiento incertidumbre desviacion excepcion omision cambio "
    U"renuncia esto todo alcance rango resultado resultados distribucion ");
/// Words in the number of a document that is not issued yet.
const WordList k_of_a_draft(
    U" draft drafts entwurf vorabzug vorlaufig vorlaeufig borrador preliminar provisional preliminary preview sample "
    U"specimen muster muestra ejemplo example beispiel espcimen especimen new neu nuevo nueva next copy kopie copia "
    U"test testing prueba probe ");
/// Words in an identification that say that it is still to come, wherever they stand.
const WordList k_to_come(
    U" tbd tba tbc tbs tbn tbf todo fixme unknown unbekannt desconocido desconocida pending ausstehend pendiente "
    U"placeholder platzhalter dummy ");
/// Words that describe how it is usually done, which identify no method.
const WordList k_usual(
    U" in house own usual usually common practice hand manual self made like last time always normal ordinary general "
    U"haus hausverfahren hauseigen eigen eigenes ublich uebliches ubliches wie letztes mal gefuhl gefuehl "
    U"ublicherweise "
    U"propio propia habitual comun siempre casa ultima vez mano inhouse selfmade ");
/// Chinese, traditional and simplified; longer ones first, because they are taken out of a text one after the other.
constexpr auto k_ideographs = std::to_array<std::u32string_view>(
    {U"沒有資料", U"没有资料", U"無此資料", U"无此资料", U"尚未提供", U"未提供", U"未填寫", U"未填写", U"未指定",
     U"未說明",   U"未说明",   U"未記錄",   U"未记录",   U"未標示",   U"未标示", U"不適用", U"不适用", U"不確定",
     U"不确定",   U"不知道",   U"不詳",     U"不详",     U"不明",     U"未知",   U"未定",   U"待定",   U"待補",
     U"待补",     U"待填",     U"暫無",     U"暂无",     U"沒有",     U"没有",   U"如上",   U"如下",   U"同上",
     U"同前",     U"同下",     U"見上",     U"见上",     U"見下",     U"见下",   U"見附件", U"见附件", U"附件",
     U"如附件",   U"略",       U"測試",     U"测试",     U"試驗",     U"试验",   U"匿名",   U"保密",   U"機密",
     U"机密",     U"空白",     U"某人",     U"某某",     U"某",       U"任何",   U"其他",   U"客戶",   U"客户",
     U"顧客",     U"名稱",     U"名称",     U"地址",     U"編號",     U"编号",   U"序號",   U"序号",   U"資料",
     U"资料",     U"無",       U"无",       U"否",       U"是",       U"的"});
/// The same, of two and more signs that other words contain or that were thought of later: taken out first.
constexpr auto k_ideographs_first = std::to_array<std::u32string_view>(
    {U"尚未提供", U"無法得知", U"无法得知", U"無法辨識", U"无法辨识", U"待確認", U"待确认", U"待確定", U"待确定",
     U"待填寫",   U"待填写",   U"請填寫",   U"请填写",   U"未檢查",   U"未检查", U"未檢驗", U"未检验", U"自訂方法",
     U"自订方法", U"詳附件",   U"详附件",   U"不提供",   U"不公開",   U"不公开", U"甲公司", U"某公司", U"暫缺",
     U"暂缺",     U"不知",     U"未有",     U"如附",     U"後補",     U"后补",   U"稍後",   U"稍后",   U"空"});
/// Signs of a number of a document that is not issued yet.
constexpr auto k_draft_ideographs = std::to_array<std::u32string_view>(
    {U"草稿", U"草案", U"樣本", U"样本", U"範例", U"范例", U"測試", U"测试", U"待定"});

/// One letter again and again, three times or more; not the Roman numeral III.
bool is_repeated(const std::u32string& word) {
    const bool digit = word.front() >= U'0' && word.front() <= U'9';
    return !digit && word.front() != U'i' && word.size() > 2 &&
           word.find_first_not_of(word.front()) == std::u32string::npos;
}

/// A run of ideographs of which nothing is left without the words for nothing.
bool is_empty_run(std::u32string word) {
    if (!std::all_of(word.begin(), word.end(), is_ideograph)) {
        return false;
    }
    const auto take_out = [&](std::u32string_view nothing) {
        for (std::size_t at = word.find(nothing); at != std::u32string::npos; at = word.find(nothing)) {
            word.erase(at, nothing.size());
        }
    };
    std::for_each(k_ideographs_first.begin(), k_ideographs_first.end(), take_out);
    std::for_each(k_ideographs.begin(), k_ideographs.end(), take_out);
    return word.empty();
}

/// "abcd", "efgh": letters in the order of the alphabet, four or more.
bool is_run_of_alphabet(const std::u32string& word) {
    constexpr std::size_t k_least = 4;
    for (std::size_t i = 1; i < word.size(); ++i) {
        if (word[i] != word[i - 1] + 1 || word[i] > U'z' || word[i - 1] < U'a') {
            return false;
        }
    }
    return word.size() >= k_least;
}

/// "xyxyxy": five letters or more, and only two different ones.
bool is_keys_pressed(const std::u32string& word) {
    constexpr std::size_t k_least = 5;
    const std::size_t other = word.find_first_not_of(word.front());
    const bool are_two = other == std::u32string::npos ||
                         word.find_first_not_of(std::u32string{word.front(), word[other]}) == std::u32string::npos;
    return word.size() >= k_least && are_two && std::none_of(word.begin(), word.end(), is_digit) &&
           std::none_of(word.begin(), word.end(), is_ideograph);
}

/// "unknown1" is "unknown".
std::u32string without_digits_behind(const std::u32string& word) {
    const std::size_t last = word.find_last_not_of(U"0123456789");
    return last == std::u32string::npos ? word : word.substr(0, last + 1);
}

bool says_nothing(const std::u32string& word) {
    return !word.empty() && (k_nothing.has(word) || is_repeated(word) || word == U"x" || word == U"xx" ||
                             is_empty_run(word) || is_run_of_alphabet(word) || is_keys_pressed(word));
}

bool is_particle_or_field(const std::u32string& word) {
    return word.size() > 1 && (k_particles.has(word) || k_fields.has(word));
}

template <class List>
bool any_within(const std::u32string& letters, const List& parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::u32string_view part) { return letters.find(part) != std::u32string::npos; });
}

/// A letter with a full stop: "A. Feld". Not the last of a text: "Kunde A."
bool has_initial(std::string_view text) {
    for (std::size_t i = 0; i + 2 < text.size(); ++i) {
        const bool begins = i == 0 || text[i - 1] == ' ';
        const bool is_letter = (text[i] >= 'A' && text[i] <= 'Z');
        if (begins && is_letter && text[i + 1] == '.') {
            return true;
        }
    }
    return false;
}

/// "A. Feld", "Land GmbH": with an initial or a legal form, words that also stand for a field or for nothing are names.
bool is_name_of_common_words(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    const auto is_form = [](const std::u32string& word) { return k_legal_forms.has(word); };
    if (!has_initial(text) && std::ranges::none_of(words, is_form)) {
        return false;
    }
    const auto is_also_name = [](const std::u32string& word) { return k_also_names.has(word); };
    return std::ranges::any_of(words, is_also_name) && std::ranges::all_of(words, [&](const std::u32string& word) {
               return word.size() == 1 || is_form(word) || is_also_name(word);
           });
}

}  // namespace

bool is_placeholder(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    if (words.empty() || says_nothing(letters_of(text))) {  // "n/a", "k. A.", "un known"
        return true;
    }
    return std::any_of(words.begin(), words.end(), says_nothing) && names_only_a_field(text);
}

bool names_only_a_field(std::string_view text) {
    if (is_name_of_common_words(text)) {
        return false;
    }
    const std::vector<std::u32string> words = words_of(text);
    const std::u32string letters = letters_of(text);
    return says_nothing(letters) || (letters.size() > 1 && k_fields.has(letters)) ||
           std::all_of(words.begin(), words.end(),
                       [](const std::u32string& word) { return says_nothing(word) || is_particle_or_field(word); });
}

bool is_particle(std::string_view text) {
    const std::u32string letters = letters_of(text);
    return k_particles.has(letters) && !k_fields.has(letters) && letters != U"no" && letters != U"not";
}

bool names_nobody(std::string_view text) {
    if (is_name_of_common_words(text)) {
        return false;
    }
    const std::vector<std::u32string> words = words_of(text);
    bool any = false;
    for (const std::u32string& word : words) {
        const std::u32string bare = without_digits_behind(word);
        const bool number = std::all_of(word.begin(), word.end(), is_digit);
        const bool says = !number && !(word.size() == 1 && !is_ideograph(word.front())) && !says_nothing(bare) &&
                          !is_particle_or_field(bare);
        if (says) {
            return k_of_nobody.has(letters_of(text));
        }
        any = any || says_nothing(bare) || is_particle_or_field(bare);
    }
    return any || k_of_nobody.has(letters_of(text));
}

bool is_still_to_come(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    const bool asked = text.find("??") != std::string_view::npos;
    return asked || std::any_of(words.begin(), words.end(), [](const std::u32string& word) {
               const bool crossed_out = word.size() > 2 && word.find_first_not_of(U'x') == std::u32string::npos;
               return crossed_out || k_to_come.has(without_digits_behind(word));
           });
}

bool has_empty_parts_only(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    return std::all_of(words.begin(), words.end(), [](const std::u32string& word) {
        return says_nothing(word) || word.find_first_not_of(U'0') == std::u32string::npos || is_particle_or_field(word);
    });
}

bool is_of_a_draft(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    return any_within(letters_of(text), k_draft_ideographs) ||
           std::any_of(words.begin(), words.end(),
                       [](const std::u32string& word) { return k_of_a_draft.has(without_digits_behind(word)); });
}

bool describes_the_usual(std::string_view text) {
    const std::vector<std::u32string> words = words_of(text);
    return std::all_of(words.begin(), words.end(), [](const std::u32string& word) {
        return k_usual.has(word) || says_nothing(word) || is_particle_or_field(word);
    });
}

std::size_t telling_words(std::string_view text) {
    std::set<std::u32string> telling;
    for (const std::u32string& word : words_of(text)) {
        const bool number = std::all_of(word.begin(), word.end(), is_digit);
        if (word.size() > 1 && !number && !says_nothing(word) && !is_particle_or_field(word) && !k_talk.has(word) &&
            !k_auxiliaries.has(word)) {
            telling.insert(word);
        }
    }
    return telling.size();
}

bool is_consent_of_nobody(std::string_view text) {
    std::vector<std::u32string> words;
    for (const std::u32string& word : words_of(text)) {
        const bool number = std::all_of(word.begin(), word.end(), is_digit);
        if (word.size() > 1 && !number && !k_particles.has(word) && !k_auxiliaries.has(word)) {
            words.push_back(word);
        }
    }
    return words.size() == 2 && k_consent.has(words.back()) && k_agreed_things.has(words.front());
}

bool is_sentence_of_fields(std::string_view text) {
    constexpr std::size_t k_least_words = 4;
    std::set<std::u32string> telling, fields;
    std::size_t count = 0;
    bool has_verb = false;
    for (const std::u32string& word : words_of(text)) {
        if (word.size() < 2) {
            continue;
        }
        ++count;
        has_verb = has_verb || k_verbs.has(word) || k_auxiliaries.has(word);
        const bool number = std::all_of(word.begin(), word.end(), is_digit);
        if (k_fields.has(word)) {
            fields.insert(word);
        } else if (!number && !says_nothing(word) && !k_particles.has(word) && !k_talk.has(word) &&
                   !k_auxiliaries.has(word) && !k_of_a_draft.has(word)) {
            telling.insert(word);
        }
    }
    return !telling.empty() && telling.size() + fields.size() > 1 && (has_verb || count >= k_least_words);
}

}  // namespace gumcert::certificate
