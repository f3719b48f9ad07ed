//! Who is let in: DNS rebinding, other pages, other programs that do not know the token, and what every answer carries.

use crate::client::{Reply, Running};
use serde_json::json;
use std::net::{Ipv4Addr, SocketAddr, TcpStream};

const PATHS: [&str; 4] = ["/", "/assets/explorer.js", "/api/start", "/api/figure/F-fig21"];

fn refused(reply: &Reply, code: &str, token: &str, what: &str) {
    assert_eq!(reply.refusal(), (403, code.to_owned()), "{what}");
    assert!(!reply.text().contains(token), "{what}");
}

/// A page of evil.example whose name the attacker points at 127.0.0.1 is same-origin to the browser; its requests say its name.
#[test]
fn a_name_that_was_pointed_here_is_refused() {
    let server = Running::new();
    let port = server.address.port();
    let hosts = [
        "evil.example".to_owned(),
        format!("evil.example:{port}"),
        format!("localhost.evil.example:{port}"),
        format!("127.0.0.1.evil.example:{port}"),
        format!("127.0.0.1:{port}.evil.example"),
        format!("evil.example@127.0.0.1:{port}"),
        format!("127.0.0.1:{port}@evil.example"),
        format!("127.0.0.1:{}", port ^ 1),
        "127.0.0.1".to_owned(),
        "localhost".to_owned(),
        format!("0.0.0.0:{port}"),
        format!("[::1]:{port}"),
        format!("127.1:{port}"),
        format!("localhost.:{port}"),
        format!("127.0.0.1:{port}, evil.example"),
        String::new(),
    ];
    for host in &hosts {
        for path in PATHS {
            let headers = [("Host", host.as_str()), ("X-Eigenbody-Token", &server.token)];
            refused(
                &server.request("GET", path, &headers, b""),
                "host",
                &server.token,
                &format!("{host} {path}"),
            );
        }
    }
    let own = [server.host(), format!("localhost:{port}"), format!("LOCALHOST:{port}")];
    for host in &own {
        let headers = [("Host", host.as_str()), ("X-Eigenbody-Token", &server.token)];
        assert_eq!(server.request("GET", "/api/start", &headers, b"").status, 200, "{host}");
    }
}

#[test]
fn no_host_two_hosts_and_another_host_in_the_target_are_refused() {
    let server = Running::new();
    let (host, token) = (server.host(), server.token.clone());
    let requests = [
        "GET / HTTP/1.0\r\n\r\n".to_owned(),
        "GET / HTTP/1.1\r\nConnection: close\r\n\r\n".to_owned(),
        format!("GET / HTTP/1.1\r\nHost: {host}\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
        format!("GET / HTTP/1.1\r\nHost: evil.example\r\nHost: {host}\r\nConnection: close\r\n\r\n"),
        format!("GET http://evil.example/ HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"),
    ];
    for request in requests {
        refused(&server.raw(request.as_bytes()).unwrap(), "host", &token, &request);
    }
}

/// A page elsewhere may send a request here without reading the answer.
#[test]
fn other_pages_are_refused() {
    let server = Running::new();
    let host = server.host();
    let port = server.address.port();
    let origins = [
        "http://evil.example".to_owned(),
        "null".to_owned(),
        format!("https://{host}"),
        format!("http://127.0.0.1:{}", port ^ 1),
        "http://127.0.0.1".to_owned(),
        format!("http://localhost.evil.example:{port}"),
        format!("http://{host}.evil.example"),
        format!("http://{host}/"),
        format!("http://evil.example http://{host}"),
        "file://".to_owned(),
        String::new(),
    ];
    for origin in &origins {
        for path in PATHS {
            let reply = server.get(path, &[("Origin", origin)]);
            refused(&reply, "origin", &server.token, &format!("{origin} {path}"));
        }
    }
    let twice = server.get("/", &[("Origin", &format!("http://{host}")), ("Origin", "http://evil.example")]);
    refused(&twice, "origin", &server.token, "two origins");
    assert_eq!(server.get("/", &[("Origin", &format!("http://{host}"))]).status, 200);
    for site in ["cross-site", "same-site", "none, cross-site", "", "same-origin cross-site"] {
        let reply = server.get("/api/start", &[("Sec-Fetch-Site", site)]);
        refused(&reply, "origin", &server.token, site);
        // As a picture, a script, a frame or a fetch.
        for (mode, dest) in
            [("no-cors", "image"), ("no-cors", "script"), ("navigate", "iframe"), ("cors", "empty")]
        {
            let fetched = [("Sec-Fetch-Site", site), ("Sec-Fetch-Mode", mode), ("Sec-Fetch-Dest", dest)];
            refused(&server.get("/", &fetched), "origin", &server.token, dest);
        }
    }
    // A link that its user follows.
    let followed =
        [("Sec-Fetch-Site", "cross-site"), ("Sec-Fetch-Mode", "navigate"), ("Sec-Fetch-Dest", "document")];
    assert_eq!(server.get("/", &followed).status, 200);
    refused(&server.get("/api/start", &followed), "origin", &server.token, "a link to an answer");
}

#[test]
fn nothing_is_answered_or_changed_without_the_token() {
    let server = Running::new();
    let (host, token) = (server.host(), server.token.clone());
    assert_eq!(token.len(), 64);
    let wrong = [
        None,
        Some(String::new()),
        Some("0".repeat(64)),
        Some(token[..63].to_owned()),
        Some(format!("{token}0")),
        Some(format!("{}{}", &token[..63], if token.ends_with('0') { '1' } else { '0' })),
        Some(token.to_uppercase()).filter(|upper| *upper != token),
        Some(format!("{token}, {token}")),
    ];
    let body = json!({ "source": { "family": "hydra(3)" } }).to_string();
    let length = body.len().to_string();
    let posts = ["model", "evaluate", "pose", "move", "swing", "path", "map", "check", "patch", "nothing"];
    for wrong in &wrong {
        let mut headers = vec![("Host", host.as_str())];
        headers.extend(wrong.as_deref().map(|wrong| ("X-Eigenbody-Token", wrong)));
        for path in ["/api/start", "/api/figure/F-fig21", "/api", "/api/nothing"] {
            refused(&server.request("GET", path, &headers, b""), "token", &token, path);
        }
        let more = [("Content-Type", "application/json"), ("Content-Length", length.as_str())];
        for path in posts {
            let reply = server.request(
                "POST",
                &format!("/api/{path}"),
                &[&headers[..], &more].concat(),
                body.as_bytes(),
            );
            refused(&reply, "token", &token, path);
        }
    }
    // Where a page elsewhere could put it: in the address or a cookie.
    let address = format!("/api/start?token={token}&X-Eigenbody-Token={token}");
    let cookie = format!("eigenbody-token={token}; X-Eigenbody-Token={token}");
    for headers in [vec![("Host", host.as_str())], vec![("Host", host.as_str()), ("Cookie", &cookie)]] {
        refused(&server.request("GET", &address, &headers, b""), "token", &token, "elsewhere");
    }
    let twice = server.get("/api/start", &[("X-Eigenbody-Token", &token)]);
    refused(&twice, "token", &token, "twice");
    // The first model ever made has the first id: none of the above made one.
    assert_eq!(server.model(&json!({ "family": "hydra(3)" }))["id"], "1");
    assert_ne!(Running::new().token, token, "every run has its own");
}

/// One of every kind of answer.
fn answers(server: &Running) -> Vec<Reply> {
    let host = server.host();
    vec![
        server.get("/", &[]),
        server.get("/assets/explorer.js", &[]),
        server.get("/assets/explorer.css", &[]),
        server.get("/api/start", &[]),
        server.get("/favicon.ico", &[]),
        server.get("/assets/nothing.js", &[]),
        server.get("/", &[("Origin", "http://evil.example")]),
        server.request("GET", "/", &[("Host", "evil.example")], b""),
        server.request("GET", "/api/start", &[("Host", &host)], b""),
        server.request(
            "OPTIONS",
            "/api/model",
            &[("Host", &host), ("Access-Control-Request-Method", "POST")],
            b"",
        ),
        server.get("/api/model", &[]),
        server.post_text("/api/model", "{"),
        server.post_text("/", "{}"),
        server.post("/api/model", &json!({ "source": { "family": "hydra(3)" } })),
        server.post("/api/model", &json!({ "source": { "family": "hydra(0)" } })),
        server.post("/api/evaluate", &json!({ "id": "77", "q": [] })),
    ]
}

#[test]
fn every_answer_has_the_strict_policy_and_lets_no_other_page_read_it() {
    let server = Running::new();
    let mut statuses = Vec::new();
    for reply in answers(&server) {
        statuses.push(reply.status);
        let policy = reply.header("content-security-policy").unwrap();
        for part in [
            "default-src 'none'",
            "script-src 'self';",
            "style-src 'self';",
            "connect-src 'self';",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        ] {
            assert!(policy.contains(part), "{policy}");
        }
        for hole in ["unsafe", "*", "http:", "https:", "ws:", "nonce", "strict-dynamic"] {
            assert!(!policy.contains(hole), "{policy}");
        }
        assert_eq!(reply.header("x-content-type-options"), Some("nosniff"));
        assert_eq!(reply.header("cross-origin-resource-policy"), Some("same-origin"));
        assert_eq!(reply.header("referrer-policy"), Some("no-referrer"));
        assert_eq!(reply.header("cache-control"), Some("no-store"));
        assert!(
            !reply.headers.iter().any(|(name, _)| name.starts_with("access-control")),
            "{:?}",
            reply.headers
        );
        assert!(reply.header("set-cookie").is_none() && reply.header("server").is_none());
        let kind = reply.header("content-type").unwrap();
        assert!(
            ["application/json", "text/html", "text/javascript", "text/css"]
                .iter()
                .any(|k| kind.starts_with(k))
        );
    }
    statuses.sort_unstable();
    statuses.dedup();
    assert_eq!(statuses, [200, 400, 403, 404, 405, 422]);
}

#[test]
fn only_two_methods_and_each_path_has_one() {
    let server = Running::new();
    let host = server.host();
    let headers = [("Host", host.as_str()), ("X-Eigenbody-Token", &server.token), ("Content-Length", "0")];
    for method in ["HEAD", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "BREW", "get"] {
        for path in ["/", "/api/start", "/api/model"] {
            let mut bytes = format!("{method} {path} HTTP/1.1\r\n").into_bytes();
            headers.iter().for_each(|(name, value)| bytes.extend(format!("{name}: {value}\r\n").bytes()));
            bytes.extend(b"Connection: close\r\n\r\n");
            // An answer to HEAD has no body.
            let mut stream = server.connect();
            std::io::Write::write_all(&mut stream, &bytes).unwrap();
            let mut line = String::new();
            std::io::BufRead::read_line(&mut std::io::BufReader::new(stream), &mut line).unwrap();
            assert!(line.starts_with("HTTP/1.1 405 "), "{method} {path}: {line}");
        }
    }
    assert_eq!(server.request("POST", "/api/start", &headers, b"").refusal(), (405, "method".into()));
    assert_eq!(server.get("/api/model", &[]).refusal(), (405, "method".into()));
    let overridden = [("X-HTTP-Method-Override", "POST"), ("X-Method-Override", "POST"), ("_method", "POST")];
    assert_eq!(server.get("/api/model?_method=POST", &overridden).refusal(), (405, "method".into()));
    let connect = server.raw(
        format!("CONNECT evil.example:443 HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").as_bytes(),
    );
    assert!(connect.is_none_or(|reply| reply.status >= 400));
}

#[test]
fn what_is_asked_never_becomes_a_header() {
    let server = Running::new();
    let broken = "%0d%0aX-Injected:%20yes%0d%0a%0d%0a<script>";
    let text =
        json!({ "source": { "text": "<robot\r\nX-Injected: yes\r\n\r\n", "name": "a\r\nX-Injected: yes" } });
    let replies = [
        server.get(&format!("/assets/{broken}"), &[]),
        server.get(&format!("/{broken}"), &[]),
        server.get(&format!("/api/figure/{broken}"), &[]),
        server.get(&format!("/?{broken}"), &[]),
        server.post("/api/model", &text),
        server.post("/api/pose", &json!({ "id": "1\r\nX-Injected: yes", "at": "zero" })),
        // A line feed alone, a header folded over two lines.
        server
            .raw(
                format!("GET / HTTP/1.1\r\nHost: {}\nX-A: b\nConnection: close\r\n\r\n", server.host())
                    .as_bytes(),
            )
            .unwrap(),
    ];
    for reply in replies {
        assert!(reply.header("x-injected").is_none(), "{:?}", reply.headers);
        assert!(!reply.text().contains("X-Injected: yes\r\n"));
    }
    let smuggled = format!(
        "POST /api/model HTTP/1.1\r\nHost: {0}\r\nX-Eigenbody-Token: {1}\r\nContent-Type: application/json\r\nContent-Length: 4\r\n\
         Transfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET / HTTP/1.1\r\nHost: {0}\r\n\r\n",
        server.host(),
        server.token
    );
    let answered = server.raw(smuggled.as_bytes()).unwrap();
    assert_eq!(answered.status, 400, "{}", answered.text());
}

#[test]
fn it_listens_on_the_loopback_interface_alone() {
    let server = Running::new();
    assert_eq!(server.address.ip(), Ipv4Addr::LOCALHOST);
    let port = server.address.port();
    // 127.0.0.2 is this machine as well, and a server on all interfaces would answer there.
    #[cfg(target_os = "linux")]
    assert!(TcpStream::connect(SocketAddr::from((Ipv4Addr::new(127, 0, 0, 2), port))).is_err());
    // The address by which others would reach this machine, if it has one. Nothing is sent.
    let outward = std::net::UdpSocket::bind("0.0.0.0:0").unwrap();
    if outward.connect("192.0.2.1:9").is_ok() {
        let own = outward.local_addr().unwrap().ip();
        if !own.is_loopback() {
            assert!(TcpStream::connect(SocketAddr::from((own, port))).is_err(), "{own}");
        }
    }
}

#[test]
fn the_page_asks_nobody_else() {
    let server = Running::new();
    let page = server.get("/", &[]).text();
    assert_eq!(page.matches(&server.token).count(), 1);
    for link in ["src=\"", "href=\"", "action=\"", "data=\"", "srcset=\""] {
        for rest in page.split(link).skip(1) {
            assert!(
                rest.starts_with("/assets/") || rest.starts_with("data:"),
                "{link}{}",
                &rest[..rest.len().min(60)]
            );
        }
    }
    assert!(
        !page.contains("://")
            && !page.contains(" on")
            && !page.contains("<style")
            && !page.contains(" style=")
    );
    let styles = server.get("/assets/explorer.css", &[]).text();
    assert!(!styles.contains("://") && !styles.contains("@import"));
    let script = server.get("/assets/explorer.js", &[]).text();
    assert!(!script.contains(&server.token));
}
