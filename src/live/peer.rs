//! Who has a connection: on Linux the system says which user a socket of this machine belongs to.
//!
//! The address with the token stands among the arguments of the browser's process, which other users may read.

use hyper::Request;
use std::net::{Ipv4Addr, SocketAddr};

/// The other end of a request's connection.
#[derive(Clone, Copy, Debug)]
pub struct Peer(pub SocketAddr);

/// Whether a request comes from another user of this machine; false where the system does not say.
pub fn is_of_another_user<B>(request: &Request<B>) -> bool {
    let Some(Peer(peer)) = request.extensions().get() else { return false };
    let sockets = std::fs::read_to_string("/proc/net/tcp").unwrap_or_default();
    own_user().zip(user_of(&sockets, *peer)).is_some_and(|(own, user)| user != own && user != ROOT)
}

/// Who may read everything anyway.
const ROOT: u32 = 0;

fn own_user() -> Option<u32> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("Uid:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// The user of the socket at an address, by the system's table of sockets (proc_pid_net(5), `tcp`).
fn user_of(sockets: &str, peer: SocketAddr) -> Option<u32> {
    let SocketAddr::V4(peer) = peer else { return None };
    sockets.lines().skip(1).find_map(|line| {
        let fields: Vec<&str> = line.split_whitespace().take(8).collect();
        let (address, port) = fields.get(1)?.split_once(':')?;
        // The address is a number as it lies in memory.
        let address = Ipv4Addr::from(u32::from_str_radix(address, 16).ok()?.to_ne_bytes());
        let is_here = address == *peer.ip() && u16::from_str_radix(port, 16) == Ok(peer.port());
        is_here.then(|| fields.get(7)?.parse().ok())?
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOCKETS: &str =
        "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode
   0: 0100007F:0BB8 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 1234 1 0000000000000000 100
   1: 0100007F:9C40 0100007F:0BB8 01 00000000:00000000 00:00000000 00000000 65534        0 1235 1 0000000000000000 20
   2: 0200007F:9C40 0100007F:0BB8 01 00000000:00000000 00:00000000 00000000  1001        0 1236 1 0000000000000000 20
";

    #[test]
    #[cfg(target_endian = "little")]
    fn the_user_of_a_socket_is_found() {
        let user = |address: &str| user_of(SOCKETS, address.parse().expect("an address"));
        assert_eq!(user("127.0.0.1:40000"), Some(65534));
        assert_eq!(user("127.0.0.2:40000"), Some(1001));
        assert_eq!(user("127.0.0.1:3000"), Some(1000));
        assert_eq!([user("127.0.0.1:40001"), user("[::1]:40000"), user_of("", ([127, 0, 0, 1], 1).into())], [None; 3]);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_connection_of_this_very_process_is_one_s_own() {
        let listener = std::net::TcpListener::bind(("127.0.0.1", 0)).expect("a port");
        let stream = std::net::TcpStream::connect(listener.local_addr().expect("bound")).expect("connected");
        let sockets = std::fs::read_to_string("/proc/net/tcp").expect("on Linux");
        assert_eq!(user_of(&sockets, stream.local_addr().expect("connected")), own_user());
        let mut request = Request::new(());
        request.extensions_mut().insert(Peer(stream.local_addr().expect("connected")));
        assert!(!is_of_another_user(&request) && !is_of_another_user(&Request::new(())));
    }
}
