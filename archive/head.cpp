#include "archive/head.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "archive/log_times.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "json/canonical_json.h"
#include "json/strict_parser.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

constexpr const char* k_head_schema = "gumcert/archive-head/1";
constexpr std::size_t k_hash_bytes = 32;
constexpr std::size_t k_signature_bytes = 64;

[[noreturn]] void refuse_head(const std::string& name, const std::string& key,
                              const char* what = " is missing or has another form") {
    throw gum::InputError(gum::Diagnostic{.code = "GC-ARCHIVE-0049",
                                          .where = name,
                                          .what = key.empty() ? "is no head of an archive" : key + what,
                                          .rule = "a head is the JSON that gumcert archive head writes",
                                          .action = "name a file that gumcert archive head has written"});
}

/// Bytes that an object has under a key as hexadecimal digits; none where they are not there, or more or fewer.
std::optional<std::string> digits_at(const nlohmann::json& object, const char* key, std::size_t size) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) {
        return std::nullopt;
    }
    std::optional<std::string> bytes = encoding::bytes_from_hexadecimal(found->get_ref<const std::string&>());
    return bytes && bytes->size() == size ? bytes : std::nullopt;
}

std::string bytes_at(const nlohmann::json& object, const char* key, std::size_t size, const std::string& name) {
    std::optional<std::string> bytes = digits_at(object, key, size);
    if (!bytes) {
        refuse_head(name, key);
    }
    return std::move(*bytes);
}

void require_known(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                   const std::string& name) {
    if (const std::string other = member_beside(object, known); !other.empty()) {
        refuse_head(name, text::visible(other), " is no member of a head that this version knows");
    }
}

Head::Extension extension_in(const nlohmann::json& value, const std::string& name) {
    require_known(value, {"size", "root", "proof"}, name);
    const nlohmann::json size = value.is_object() ? value.value("size", nlohmann::json()) : nlohmann::json();
    const nlohmann::json proof = value.is_object() ? value.value("proof", nlohmann::json()) : nlohmann::json();
    if (!size.is_number_integer() || size.get<std::int64_t>() < 1 || !proof.is_array()) {
        refuse_head(name, "extends");
    }
    Head::Extension extension{size.get<std::int64_t>(), bytes_at(value, "root", k_hash_bytes, name), {}};
    for (const nlohmann::json& node : proof) {
        extension.proof.push_back(bytes_at({{"proof", node}}, "proof", k_hash_bytes, name));
    }
    return extension;
}

nlohmann::json unsigned_json(const Head& head) {
    nlohmann::json object{{"schema", k_head_schema},
                          {"archive", encoding::hexadecimal(head.archive)},
                          {"size", head.size},
                          {"root", encoding::hexadecimal(head.root)},
                          {"chain", encoding::hexadecimal(head.chain)},
                          {"at", head.at}};
    if (!head.clock.empty()) {
        object[k_clock] = head.clock;
    }
    return object;
}

}  // namespace

void WalkedLog::add(const LogEntry& entry) {
    if (tree_.size() == 0) {
        head_.archive = entry.hash;
    }
    tree_.add(entry.hash);
    head_.size = static_cast<std::int64_t>(tree_.size());
    head_.chain = entry.hash;
    head_.at = entry.at;
    head_.clock = clock_of(entry);
}

Head WalkedLog::head() const {
    Head head = head_;
    head.root = tree_.root();
    return head;
}

std::optional<Head> WalkedLog::head_since(const Head& earlier) const {
    if (earlier.size < 1 || earlier.size > head_.size || earlier.archive != head_.archive) {
        return std::nullopt;
    }
    const auto size = static_cast<std::size_t>(earlier.size);
    if (tree_.root(size) != earlier.root) {
        return std::nullopt;
    }
    Head later = head();
    later.extends = Head::Extension{earlier.size, earlier.root, tree_.consistency_proof(size, tree_.size())};
    return later;
}

bool ends_with(const Head& head, std::string_view chain, std::string_view at, std::string_view clock) {
    return head.chain == chain && head.at == at && (head.clock.empty() || head.clock == clock);
}

bool is_same_log(const Head& one, const Head& other) {
    return one.root == other.root &&
           (ends_with(one, other.chain, other.at, other.clock) || ends_with(other, one.chain, one.at, one.clock));
}

const std::string& time_of(const Head& head) {
    return head.clock.empty() ? head.at : head.clock;
}

std::string time_in_words(const Head& head) {
    return head.clock.empty() ? head.at : head.clock + " (by its log " + head.at + ", of a clock that was ahead)";
}

bool proves_its_extension(const Head& head) {
    return head.extends && head.extends->size >= 1 &&
           is_extended(static_cast<std::size_t>(head.extends->size), head.extends->root,
                       static_cast<std::size_t>(head.size), head.root, head.extends->proof);
}

bool proves_extension(const Head& later, const Head& earlier) {
    if (later.archive != earlier.archive) {
        return false;
    }
    // The proof is of roots; the last entry and its time are told beside it. Of one size it is the same head, and nothing to
    // be proved.
    if (later.size == earlier.size) {
        return is_same_log(later, earlier);
    }
    return later.extends && later.extends->size == earlier.size && later.extends->root == earlier.root &&
           proves_its_extension(later) && later.at >= earlier.at;
}

bool leads_to(const Head& later, const Head& earlier, const std::vector<Head>& known,
              const std::function<bool(const Head&, const Head&)>& proves) {
    std::vector<const Head*> reached{&later};
    std::vector<bool> is_reached(known.size(), false);
    for (std::size_t next = 0; next < reached.size(); ++next) {
        const Head& from = *reached[next];
        if (proves(from, earlier)) {
            return true;
        }
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (!is_reached[i] && proves(from, known[i])) {
                is_reached[i] = true;
                reached.push_back(&known[i]);
            }
        }
    }
    return false;
}

std::string signed_bytes(const Head& head) {
    return gumcert::json::canonical_json(unsigned_json(head));
}

nlohmann::json to_json(const Head::Signature& signature) {
    return {{"algorithm", "Ed25519"},
            {"public_key", encoding::hexadecimal(signature.public_key)},
            {"value", encoding::hexadecimal(signature.value)}};
}

std::string member_beside(const nlohmann::json& object, std::initializer_list<std::string_view> known) {
    if (object.is_object()) {
        for (const auto& [key, value] : object.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                return key.empty() ? "\"\"" : key;
            }
        }
    }
    return "";
}

std::optional<Head::Signature> signature_in(const nlohmann::json& value) {
    if (!value.is_object() || !member_beside(value, {"algorithm", "public_key", "value"}).empty() ||
        value.value("algorithm", nlohmann::json()) != "Ed25519") {
        return std::nullopt;
    }
    const std::optional<std::string> key = digits_at(value, "public_key", k_hash_bytes);
    const std::optional<std::string> signature = digits_at(value, "value", k_signature_bytes);
    return key && signature ? std::optional(Head::Signature{*key, *signature}) : std::nullopt;
}

std::string to_json(const Head& head) {
    nlohmann::json object = unsigned_json(head);
    if (head.signature) {
        object["signature"] = to_json(*head.signature);
    }
    if (head.extends) {
        nlohmann::json proof = nlohmann::json::array();
        for (const std::string& node : head.extends->proof) {
            proof.push_back(encoding::hexadecimal(node));
        }
        object["extends"] = {{"size", head.extends->size},
                             {"root", encoding::hexadecimal(head.extends->root)},
                             {"proof", std::move(proof)}};
    }
    return gumcert::json::canonical_json(object);
}

Head head_from_json(std::string_view text, const std::string& name) {
    const std::optional<nlohmann::json> object = gumcert::json::parse_faultless(text, {});
    if (!object) {
        refuse_head(name, "");
    }
    return head_in(*object, name);
}

Head head_in(const nlohmann::json& object, const std::string& name) {
    if (!object.is_object() || object.value("schema", nlohmann::json()) != k_head_schema) {
        refuse_head(name, "");
    }
    require_known(object, {"schema", "archive", "size", "root", "chain", "at", k_clock, "signature", "extends"}, name);
    Head head;
    head.archive = bytes_at(object, "archive", k_hash_bytes, name);
    head.root = bytes_at(object, "root", k_hash_bytes, name);
    head.chain = bytes_at(object, "chain", k_hash_bytes, name);
    const nlohmann::json size = object.value("size", nlohmann::json());
    const nlohmann::json at = object.value("at", nlohmann::json());
    if (!size.is_number_integer() || size.get<std::int64_t>() < 1) {
        refuse_head(name, "size");
    }
    // It is printed, and compared as a text: nothing but a time may stand there.
    if (!at.is_string() || !is_utc_time(at.get_ref<const std::string&>())) {
        refuse_head(name, "at");
    }
    head.size = size.get<std::int64_t>();
    head.at = at.get<std::string>();
    if (const auto clock = object.find(k_clock); clock != object.end()) {
        if (!clock->is_string() || !is_utc_time(clock->get_ref<const std::string&>()) ||
            clock->get_ref<const std::string&>() >= head.at) {
            refuse_head(name, k_clock);
        }
        head.clock = clock->get<std::string>();
    }
    if (const auto signature = object.find("signature"); signature != object.end()) {
        head.signature = signature_in(*signature);
        if (!head.signature) {
            refuse_head(name, "signature");
        }
    }
    if (const auto extends = object.find("extends"); extends != object.end()) {
        head.extends = extension_in(*extends, name);
    }
    return head;
}

}  // namespace gumcert::archive
