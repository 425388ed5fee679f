// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "security/handshake_probe.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <memory>

#include "core/base/file_descriptor.h"
#include "security/openssl_handles.h"

namespace orbweave {
namespace {

using ContextHandle = std::unique_ptr<SSL_CTX, OpenSslDeleter<SSL_CTX_free>>;
using ConnectionHandle = std::unique_ptr<SSL, OpenSslDeleter<SSL_free>>;
using AddressesHandle = std::unique_ptr<addrinfo, OpenSslDeleter<::freeaddrinfo>>;

/// Keeps SIGPIPE from this thread: OpenSSL writes to sockets that may be closed.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    constexpr timespec kAtOnce{};
    ::sigtimedwait(&pipe_, nullptr, &kAtOnce);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
};

/// "host:port", with brackets around an address that has colons itself.
struct HostAndPort {
  std::string host{};
  std::string port{};
};

HostAndPort Split(const std::string& address) {
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos) return {};
  HostAndPort parts{address.substr(0, colon), address.substr(colon + 1)};
  if (parts.host.starts_with('[') && parts.host.ends_with(']'))
    parts.host = parts.host.substr(1, parts.host.size() - 2);
  return parts;
}

FileDescriptor Connect(const HostAndPort& server) {
  constexpr timeval kPatience{.tv_sec = 2, .tv_usec = 0};
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(server.host.c_str(), server.port.c_str(), &hints, &found) != 0) return {};
  const AddressesHandle addresses(found);
  for (const addrinfo* at = addresses.get(); at != nullptr; at = at->ai_next) {
    FileDescriptor socket(::socket(at->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof(kPatience));
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof(kPatience));
    if (::connect(socket.get(), at->ai_addr, at->ai_addrlen) == 0) return socket;
  }
  return {};
}

bool ShowCertificate(SSL_CTX& context, const TlsFolder& folder) {
  return SSL_CTX_use_certificate_chain_file(&context, folder.CertificatePath().c_str()) == 1 &&
         SSL_CTX_use_PrivateKey_file(&context, folder.KeyPath().c_str(), SSL_FILETYPE_PEM) == 1;
}

ContextHandle MakeContext(const TlsFolder& folder, Caller caller) {
  ContextHandle context(SSL_CTX_new(TLS_client_method()));
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  const bool is_whole =
      SSL_CTX_load_verify_file(context.get(), folder.AuthorityPath().c_str()) == 1 &&
      (caller == Caller::kStranger || ShowCertificate(*context, folder));
  return is_whole ? std::move(context) : nullptr;
}

/// The other side's certificate is to name `host`.
void ExpectHost(SSL& connection, const std::string& host) {
  std::array<unsigned char, 16> address{};
  const bool is_address = ::inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
                          ::inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
  if (is_address) {
    X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(&connection), host.c_str());
  } else {
    SSL_set1_host(&connection, host.c_str());
    SSL_set_tlsext_host_name(&connection, host.c_str());
  }
}

/// The connection of a caller who speaks gRPC's protocol.
ConnectionHandle MakeConnection(SSL_CTX& context, BIO& wire) {
  static constexpr std::array<unsigned char, 3> kHttp2 = {2, 'h', '2'};
  ConnectionHandle connection(SSL_new(&context));
  SSL_set_alpn_protos(connection.get(), kHttp2.data(), kHttp2.size());
  SSL_set_bio(connection.get(), &wire, &wire);
  return connection;
}

/// Whether OpenSSL's last error is an alert that the other side sent.
bool IsAlert() { return ERR_GET_REASON(ERR_peek_last_error()) >= SSL_AD_REASON_OFFSET; }

/// A caller of TLS 1.3 has shaken hands before the server has looked at its certificate. Who is
/// taken gets the first bytes of HTTP/2 at once.
Handshake FirstAnswer(SSL& connection) {
  char byte = 0;
  if (SSL_read(&connection, &byte, 1) == 1) return Handshake::kCompleted;
  const bool is_waiting = errno == EAGAIN || errno == EWOULDBLOCK;
  return is_waiting && !IsAlert() ? Handshake::kUnclear : Handshake::kCallerRefused;
}

}  // namespace

Handshake ProbeHandshake(const std::string& address,
                         const TlsFolder& folder,
                         Caller caller,
                         KnownBy known_by) {
  const WithoutSigpipe guard;
  const HostAndPort server = Split(address);
  const ContextHandle context = MakeContext(folder, caller);
  const FileDescriptor socket = Connect(server);
  Handshake outcome = Handshake::kUnclear;
  if (context != nullptr && socket.IsOpen()) {
    const ConnectionHandle connection =
        MakeConnection(*context, *BIO_new_socket(socket.get(), BIO_NOCLOSE));
    if (known_by == KnownBy::kHost) ExpectHost(*connection, server.host);
    errno = 0;
    ERR_clear_error();
    if (SSL_connect(connection.get()) == 1) {
      outcome = FirstAnswer(*connection);
    } else if (SSL_get_verify_result(connection.get()) != X509_V_OK) {
      outcome = Handshake::kServerRefused;
    } else if (IsAlert()) {
      outcome = Handshake::kCallerRefused;
    }
  }
  ERR_clear_error();
  return outcome;
}

}  // namespace orbweave
