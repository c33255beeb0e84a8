// Compiled as a release and linked first, see tests/CMakeLists.txt: all that the headers of tests/compiled_once name.
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

template class std::basic_string<char>;
template class std::vector<char>;
template class std::vector<double>;
template class std::vector<std::size_t>;
template class std::vector<std::string>;
template class std::vector<std::pair<std::string, std::string>>;
template class std::set<std::string>;
template class std::map<std::string, std::string>;
template class nlohmann::basic_json<>;
template class nlohmann::basic_json<nlohmann::ordered_map>;
template class std::vector<nlohmann::json>;
template class std::vector<nlohmann::ordered_json>;
template class std::map<std::string, nlohmann::json, std::less<void>>;

namespace nlohmann::detail {

using TextInput = decltype(input_adapter(std::declval<const std::string&>()));
using CharacterInput = decltype(input_adapter(std::declval<const char*>()));

template class lexer<json, TextInput>;
template class lexer<ordered_json, TextInput>;
template class lexer<json, CharacterInput>;
template class lexer<json, input_stream_adapter>;
template class parser<json, TextInput>;
template class parser<ordered_json, TextInput>;
template class parser<json, CharacterInput>;
template class parser<json, input_stream_adapter>;
template class json_sax_dom_parser<json>;
template class json_sax_dom_callback_parser<json>;
template class serializer<json>;
template class serializer<ordered_json>;

}  // namespace nlohmann::detail
