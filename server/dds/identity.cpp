#include "dds/identity.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509_vfy.h>

#include <ctime>
#include <memory>
#include <string>

namespace camdir::dds {
namespace {

namespace fs = std::filesystem;

template <auto release>
struct Release {
    template <class T>
    void operator()(T* object) const {
        release(object);
    }
};
template <class T, auto release>
using Owned = std::unique_ptr<T, Release<release>>;

using Bio = Owned<BIO, BIO_free_all>;
using Certificate = Owned<X509, X509_free>;
using RevocationList = Owned<X509_CRL, X509_CRL_free>;
using Key = Owned<EVP_PKEY, EVP_PKEY_free>;
using Store = Owned<X509_STORE, X509_STORE_free>;
using Verification = Owned<X509_STORE_CTX, X509_STORE_CTX_free>;
using Signed = Owned<PKCS7, PKCS7_free>;

constexpr const char* made_anew = ": expected one that authority.sh has made: renew the identity";

// Of the last failure of OpenSSL on this thread.
std::string openssl_reason() {
    const char* reason = ::ERR_reason_error_string(::ERR_peek_last_error());
    ::ERR_clear_error();
    return reason == nullptr ? "unknown error" : reason;
}

// No passphrase is asked for: what has one cannot be read.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writes*/, void* /*context*/) {
    return -1;
}

template <class Object, auto read>
Result<Object> read_pem(const fs::path& file, const std::string& what) {
    const Bio in(::BIO_new_file(file.c_str(), "r"));
    Object object(in ? read(in.get(), nullptr, no_passphrase, nullptr) : nullptr);
    if (!object) return fail(file.string() + ": is no " + what + " (" + openssl_reason() + ")" + made_anew);
    return object;
}

Result<Certificate> read_certificate(const fs::path& file) {
    return read_pem<Certificate, PEM_read_bio_X509>(file, "certificate");
}

Result<std::chrono::system_clock::time_point> expiry(const X509& certificate, const fs::path& file) {
    std::tm parts{};
    if (::ASN1_TIME_to_tm(::X509_get0_notAfter(&certificate), &parts) != 1)
        return fail(file.string() + ": has no time at which it expires" + made_anew);
    return std::chrono::system_clock::from_time_t(::timegm(&parts));
}

// What is wrong with which file, and what to do.
std::string explain(int error, const fs::path& folder) {
    const auto of = [&](const char* name) { return (folder / name).string(); };
    const std::string reason = ::X509_verify_cert_error_string(error);
    switch (error) {
        case X509_V_ERR_CERT_HAS_EXPIRED:
            return of("certificate.pem") + ": has expired, or its CA has: renew the identity";
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return of("certificate.pem") +
                   ": is not valid yet: check the clock of this machine and of the authority's";
        case X509_V_ERR_CERT_REVOKED:
            return of("certificate.pem") + ": is revoked: renew the identity";
        case X509_V_ERR_CRL_NOT_YET_VALID:
            return of("revoked.pem") +
                   ": is not valid yet: check the clock of this machine and of the authority's";
        case X509_V_ERR_CRL_HAS_EXPIRED:
        case X509_V_ERR_UNABLE_TO_GET_CRL:
        case X509_V_ERR_CRL_SIGNATURE_FAILURE:
            return of("revoked.pem") + ": " + reason + ": take the one of the authority that has made " +
                   of("certificate.pem");
        default:
            return of("certificate.pem") + ": is not signed by " + of("identity_ca.pem") + " (" + reason +
                   "): take both from one folder of the authority";
    }
}

Result<void> check_certificate(X509& certificate, const fs::path& folder) {
    const auto authority = read_certificate(folder / "identity_ca.pem");
    if (!authority) return tl::unexpected(authority.error());
    const auto revoked =
        read_pem<RevocationList, PEM_read_bio_X509_CRL>(folder / "revoked.pem", "list of the revoked");
    if (!revoked) return tl::unexpected(revoked.error());
    const Store store(::X509_STORE_new());
    const Verification verification(::X509_STORE_CTX_new());
    if (!store || !verification || ::X509_STORE_add_cert(store.get(), authority->get()) != 1 ||
        ::X509_STORE_add_crl(store.get(), revoked->get()) != 1 ||
        ::X509_STORE_set_flags(store.get(), X509_V_FLAG_CRL_CHECK) != 1 ||
        ::X509_STORE_CTX_init(verification.get(), store.get(), &certificate, nullptr) != 1)
        return fail(folder.string() + ": cannot be checked: " + openssl_reason());
    if (::X509_verify_cert(verification.get()) == 1) return {};
    return fail(explain(::X509_STORE_CTX_get_error(verification.get()), folder));
}

Result<void> check_key(X509& certificate, const fs::path& folder) {
    const fs::path file = folder / "key.pem";
    const auto key = read_pem<Key, PEM_read_bio_PrivateKey>(file, "private key without a passphrase");
    if (!key) return tl::unexpected(key.error());
    if (::X509_check_private_key(&certificate, key->get()) == 1) return {};
    ::ERR_clear_error();
    return fail(file.string() + ": does not belong to " + (folder / "certificate.pem").string() +
                ": take both from one folder of the authority");
}

Result<void> check_signed(const fs::path& file, X509_STORE& authorities, const fs::path& authority) {
    const Bio in(::BIO_new_file(file.c_str(), "r"));
    BIO* found = nullptr;
    const Signed message(in ? ::SMIME_read_PKCS7(in.get(), &found) : nullptr);
    const Bio content(found);
    if (!message)
        return fail(file.string() + ": is no signed document (" + openssl_reason() + ")" + made_anew);
    if (::PKCS7_verify(message.get(), nullptr, &authorities, content.get(), nullptr, PKCS7_TEXT) == 1)
        return {};
    return fail(file.string() + ": is not signed by " + authority.string() + " (" + openssl_reason() +
                "): take both from one folder of the authority");
}

Result<void> check_permissions(const fs::path& folder) {
    const fs::path authority = folder / "permissions_ca.pem";
    const auto certificate = read_certificate(authority);
    if (!certificate) return tl::unexpected(certificate.error());
    const Store store(::X509_STORE_new());
    if (!store || ::X509_STORE_add_cert(store.get(), certificate->get()) != 1)
        return fail(authority.string() + ": cannot be used: " + openssl_reason());
    for (const char* name : {"governance.p7s", "permissions.p7s"})
        if (auto checked = check_signed(folder / name, *store, authority); !checked) return checked;
    return {};
}

}  // namespace

Result<Identity> read_identity(const fs::path& folder) {
    ::ERR_clear_error();
    const fs::path file = folder / "certificate.pem";
    const auto certificate = read_certificate(file);
    if (!certificate) return tl::unexpected(certificate.error());
    const auto expires = expiry(**certificate, file);
    if (!expires) return tl::unexpected(expires.error());
    for (const auto& checked : {check_certificate(**certificate, folder), check_key(**certificate, folder),
                                check_permissions(folder)})
        if (!checked) return tl::unexpected(checked.error());
    return Identity{*expires};
}

}  // namespace camdir::dds
