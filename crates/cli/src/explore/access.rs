//! Who may ask: requests that carry the word of the page in their path, from the page itself.
//!
//! A page elsewhere on the web can send requests to a server on the loopback address, and a name of its own can be made to lead there. So the word is random and never
//! leaves the address of the page, the host must be the loopback address with the port of the server, and an origin, which browsers send with every request of a
//! script to another site and with every POST, must be that of the page.

use std::io;

use hyper::header::{CONTENT_TYPE, HOST, HeaderMap, HeaderName, ORIGIN};
use hyper::{Method, StatusCode};

/// Bytes of the word.
const WORD_BYTES: usize = 16;
/// What a browser says of the site that sends a request.
const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

/// The word of the page, and the hosts that stand for the server.
#[derive(Debug, Clone)]
pub(super) struct Access {
    word: String,
    hosts: [String; 2],
}

impl Access {
    /// A new word for a server on `port`.
    pub(super) fn new(port: u16) -> io::Result<Self> {
        let mut bytes = [0; WORD_BYTES];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let word = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { word, hosts: ["127.0.0.1", "localhost"].map(|host| format!("{host}:{port}")) })
    }

    /// Address of the page.
    pub(super) fn page(&self) -> String {
        format!("http://{}/{}/", self.hosts[0], self.word)
    }

    /// Name of what is asked for at `path`, or the status of the refusal.
    pub(super) fn name<'a>(&self, method: &Method, path: &'a str, headers: &HeaderMap) -> Result<&'a str, StatusCode> {
        let one = |name: &HeaderName| {
            let mut values = headers.get_all(name).iter();
            match (values.next(), values.next()) {
                (None, _) => Ok(None),
                (Some(value), None) => value.to_str().map(Some).map_err(|_| StatusCode::BAD_REQUEST),
                (Some(_), Some(_)) => Err(StatusCode::BAD_REQUEST),
            }
        };
        let host = one(&HOST)?.ok_or(StatusCode::BAD_REQUEST)?;
        if !self.hosts.iter().any(|own| own == host) {
            return Err(StatusCode::MISDIRECTED_REQUEST);
        }
        let origin = one(&ORIGIN)?;
        let is_own = |origin: &str| origin.strip_prefix("http://") == Some(host);
        if origin.is_some_and(|origin| !is_own(origin)) || (method == Method::POST && origin.is_none()) {
            return Err(StatusCode::FORBIDDEN);
        }
        if one(&SITE)?.is_some_and(|site| !matches!(site, "same-origin" | "none")) {
            return Err(StatusCode::FORBIDDEN);
        }
        if method == Method::POST && one(&CONTENT_TYPE)? != Some("application/json") {
            return Err(StatusCode::UNSUPPORTED_MEDIA_TYPE);
        }
        let (word, name) = path.strip_prefix('/').and_then(|path| path.split_once('/')).ok_or(StatusCode::NOT_FOUND)?;
        if is_same(word.as_bytes(), self.word.as_bytes()) { Ok(name) } else { Err(StatusCode::NOT_FOUND) }
    }
}

/// Whether both are equal, in a time that does not tell where they differ.
fn is_same(one: &[u8], other: &[u8]) -> bool {
    one.len() == other.len() && one.iter().zip(other).fold(0, |differs, (a, b)| differs | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(access: &Access, method: &Method, path: &str, headers: &[(&'static str, &str)]) -> Option<u16> {
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(HeaderName::from_static(name), value.parse().unwrap());
        }
        access.name(method, path, &map).err().map(|status| status.as_u16())
    }

    #[test]
    fn only_the_page_itself_may_ask() {
        let access = Access::new(8000).unwrap();
        let other = Access::new(8000).unwrap();
        let page = access.page().replace("http://127.0.0.1:8000", "");
        let host = ("host", "127.0.0.1:8000");
        let own = ("origin", "http://127.0.0.1:8000");
        let json = ("content-type", "application/json");
        let (get, post) = (Method::GET, Method::POST);
        assert_eq!(asked(&access, &get, &page, &[host]), None);
        assert_eq!(asked(&access, &get, &page, &[("host", "localhost:8000")]), None);
        assert_eq!(asked(&access, &post, &page, &[host, own, json]), None);
        assert_eq!(asked(&other, &get, &page, &[host]), Some(404));
        assert_eq!(asked(&access, &get, "/", &[host]), Some(404));
        assert_eq!(asked(&access, &get, &page, &[]), Some(400));
        assert_eq!(asked(&access, &get, &page, &[host, host]), Some(400));
        for name in ["gear.example:8000", "127.0.0.1", "127.0.0.1:8001"] {
            assert_eq!(asked(&access, &get, &page, &[("host", name)]), Some(421), "{name}");
        }
        for origin in ["http://gear.example", "null", "https://127.0.0.1:8000", "http://localhost:8000"] {
            assert_eq!(asked(&access, &get, &page, &[host, ("origin", origin)]), Some(403), "{origin}");
        }
        assert_eq!(asked(&access, &get, &page, &[host, ("sec-fetch-site", "cross-site")]), Some(403));
        assert_eq!(asked(&access, &post, &page, &[host, json]), Some(403));
        assert_eq!(asked(&access, &post, &page, &[host, own, ("content-type", "text/plain")]), Some(415));
    }
}
