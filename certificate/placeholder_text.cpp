#include "certificate/placeholder_text.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "certificate/text_words.h"

namespace gumcert::certificate {

namespace {

/// Words that say that there is nothing, or that it stands elsewhere, or that somebody tried a form out. Small letters,
/// without accents.
constexpr std::u32string_view k_nothing =
    // English
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
    U"lorem ipsum dolor sit amet asdf asdfg asdfgh asdfghjkl sdf jkl hjkl qwerty qwert qwertz azerty yxcv zxcv abc "
    U"abcd "
    U"abcde xyz bla blah blub blabla blahblah yada etc false true undefined error ref nr no yes yep nope "
    // German
    U"unbekannt unbekannte unbekannter unbekanntes unbenannt ungenannt keine keiner keines kein nichts fehlt fehlend "
    U"entfallt entfaellt nv ka kd noch offen folgt spater spaeter siehe oben unten ohne anlage anhang beilage "
    U"beigefugt "
    U"wie zuvor gleich dasselbe angabe angaben anwendbar zutreffend verfugbar verfuegbar bekannt angegeben "
    U"vorhanden festgelegt benannt erfasst jemand niemand irgendwer irgendwas irgendetwas diverse verschiedene anonym "
    U"vertraulich geheim probe platzhalter muster leer ja nein "
    // Spanish
    U"desconocido desconocida desconocidos desconocidas ninguno ninguna ningun nada nadie vacio vacia falta faltante "
    U"pendiente aplica aplicable disponible especificado especificada especificar indicar indicado indicada conocido "
    U"conocida "
    U"proporcionado definido definida determinar definir confirmar consta datos dato sd vease ver arriba abajo adjunto "
    U"anexo anterior idem mismo misma alguien algo cualquiera varios varias anonimo anonima confidencial secreto "
    U"prueba pruebas si sin ";
/// Words that do not change that: articles, particles.
constexpr std::u32string_view k_particles =
    U" a an the of to be is are was were it its in on at for from by with and or as not see this that yet still been "
    U"will our my your their his her all "
    U"der die das des dem den ein eine einer und oder von zu zur zum im am mit ist sind wird werden nicht noch als fur "
    U"fuer nach "
    U"el la los las un una de del en por para con es son no se lo al como ";
/// Names of fields, which tell nothing of their own.
constexpr std::u32string_view k_fields =
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
    U"instalaciones ";
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

bool stands_in(std::u32string_view list, const std::u32string& word) {
    return list.find(U' ' + word + U' ') != std::u32string_view::npos;
}

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
    for (const std::u32string_view nothing : k_ideographs) {
        for (std::size_t at = word.find(nothing); at != std::u32string::npos; at = word.find(nothing)) {
            word.erase(at, nothing.size());
        }
    }
    return word.empty();
}

bool says_nothing(const std::u32string& word) {
    return !word.empty() &&
           (stands_in(k_nothing, word) || is_repeated(word) || word == U"x" || word == U"xx" || is_empty_run(word));
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
    const std::vector<std::u32string> words = words_of(text);
    const std::u32string letters = letters_of(text);
    return says_nothing(letters) || (letters.size() > 1 && stands_in(k_fields, letters)) ||
           std::all_of(words.begin(), words.end(), [](const std::u32string& word) {
               return says_nothing(word) ||
                      (word.size() > 1 && (stands_in(k_particles, word) || stands_in(k_fields, word)));
           });
}

}  // namespace gumcert::certificate
