// JSON for tests that are not optimised: what support/optimised_templates.cpp has compiled is not compiled once more.
#pragma once

#include_next <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class std::vector<nlohmann::json>;
extern template class std::vector<nlohmann::ordered_json>;
extern template class std::map<std::string, nlohmann::json, std::less<void>>;

namespace nlohmann::detail {

using TextInput = decltype(input_adapter(std::declval<const std::string&>()));
using CharacterInput = decltype(input_adapter(std::declval<const char*>()));

extern template class lexer<json, TextInput>;
extern template class lexer<ordered_json, TextInput>;
extern template class lexer<json, CharacterInput>;
extern template class lexer<json, input_stream_adapter>;
extern template class parser<json, TextInput>;
extern template class parser<ordered_json, TextInput>;
extern template class parser<json, CharacterInput>;
extern template class parser<json, input_stream_adapter>;
extern template class json_sax_dom_parser<json>;
extern template class json_sax_dom_callback_parser<json>;
extern template class serializer<json>;
extern template class serializer<ordered_json>;

}  // namespace nlohmann::detail
