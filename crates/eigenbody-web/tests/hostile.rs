//! Requests made to break it: too large, too slow, too deep, too many, of the wrong shape. An answer, in bounded time, and never a 5xx.

use crate::client::{Running, read};
use eigenbody::model::Random;
use serde_json::{Value, json};
use std::io::{BufReader, Write};
use std::time::{Duration, Instant};

fn head(server: &Running, more: &str) -> String {
    format!(
        "POST /api/model HTTP/1.1\r\nHost: {}\r\nX-Eigenbody-Token: {}\r\nContent-Type: application/json\r\nConnection: close\r\n{more}\r\n",
        server.host(),
        server.token
    )
}

#[test]
fn a_body_that_says_that_it_is_too_large_is_refused_unread() {
    let server = Running::new();
    for length in ["4194305", "999999999999", "9223372036854775807"] {
        let reply = server.raw(head(&server, &format!("Content-Length: {length}\r\n")).as_bytes()).unwrap();
        assert_eq!(reply.refusal(), (413, "large".into()), "{length}");
    }
    let small = "x".repeat(300 * 1024);
    for path in ["evaluate", "pose", "move", "swing", "path", "map", "check", "patch"] {
        let reply = server.post_text(&format!("/api/{path}"), &small);
        assert_eq!(reply.refusal(), (413, "large".into()), "{path}");
    }
}

#[test]
fn a_body_that_does_not_say_so_is_cut_off() {
    let server = Running::new();
    let mut stream = server.connect();
    stream.write_all(head(&server, "Transfer-Encoding: chunked\r\n").as_bytes()).unwrap();
    let chunk = format!("10000\r\n{}\r\n", "x".repeat(0x10000));
    // 25 MB: far more than the limit and what sockets buffer.
    let is_cut = (0..400).any(|_| stream.write_all(chunk.as_bytes()).is_err());
    // The answer may be lost where the connection is reset under what is still being sent.
    let reply = if is_cut { None } else { read(&mut BufReader::new(stream)) };
    assert!(is_cut || reply.is_some_and(|reply| reply.refusal() == (413, "large".into())));
    assert_eq!(server.get("/api/start", &[]).status, 200);
}

#[test]
fn other_kinds_of_bodies_are_refused() {
    let server = Running::new();
    let (host, body) = (server.host(), r#"{"source":{"family":"hydra(3)"}}"#);
    // What a form or a plain fetch of another page can send without asking first, and others.
    for kind in [
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data; boundary=x",
        "text/json",
        "",
    ] {
        let headers = [
            ("Host", host.as_str()),
            ("X-Eigenbody-Token", &server.token),
            ("Content-Type", kind),
            ("Content-Length", "32"),
        ];
        assert_eq!(
            server.request("POST", "/api/model", &headers, body.as_bytes()).refusal(),
            (415, "media".into()),
            "{kind}"
        );
    }
}

/// Half a request holds nothing for long: a head has five seconds, a body ten.
#[test]
fn slow_requests_end() {
    let server = Running::new();
    let began = Instant::now();
    let host = server.host();
    std::thread::scope(|scope| {
        let silent = scope.spawn(|| read(&mut BufReader::new(server.connect())));
        let half_a_head =
            scope.spawn(|| server.raw(format!("GET / HTTP/1.1\r\nHost: {host}\r\nX-A").as_bytes()));
        let half_a_body =
            scope.spawn(|| server.raw((head(&server, "Content-Length: 100\r\n") + "{").as_bytes()));
        // A byte a second keeps a head no longer.
        let trickle = scope.spawn(|| {
            let mut stream = server.connect();
            for byte in b"GET / HTTP/1.1\r\nX-Slow: aaaaaaaaaaaaaaaa" {
                if stream.write_all(&[*byte]).is_err() {
                    break;
                }
                std::thread::sleep(Duration::from_millis(500));
            }
            read(&mut BufReader::new(stream))
        });
        assert!(silent.join().unwrap().is_none());
        assert!(half_a_head.join().unwrap().is_none_or(|reply| reply.status == 408));
        assert_eq!(half_a_body.join().unwrap().unwrap().refusal(), (408, "slow".into()));
        assert!(trickle.join().unwrap().is_none_or(|reply| reply.status == 408));
    });
    // Far less than the sixty seconds after which the client would give up.
    assert!(began.elapsed() < Duration::from_secs(45));
    // A body that breaks off.
    let mut stream = server.connect();
    stream.write_all((head(&server, "Content-Length: 100\r\n") + "{").as_bytes()).unwrap();
    stream.shutdown(std::net::Shutdown::Write).unwrap();
    assert!(read(&mut BufReader::new(stream)).is_none_or(|reply| reply.status == 400));
    assert_eq!(server.get("/api/start", &[]).status, 200);
}

#[test]
fn heads_are_bounded() {
    let server = Running::new();
    let host = server.host();
    let long = "a".repeat(200 * 1024);
    let many: String = (0..5000).map(|k| format!("X-{k}: {k}\r\n")).collect();
    for request in [
        format!("GET /{long} HTTP/1.1\r\nHost: {host}\r\n\r\n"),
        format!("GET / HTTP/1.1\r\nHost: {host}\r\nX-Long: {long}\r\n\r\n"),
        format!("GET / HTTP/1.1\r\nHost: {host}\r\n{many}\r\n"),
    ] {
        assert!(server.raw(request.as_bytes()).is_none_or(|reply| matches!(reply.status, 400 | 414 | 431)));
    }
    for nonsense in [
        "\r\n\r\n\r\n",
        "\0\0\0\0\r\n\r\n",
        "GET\r\n\r\n",
        "GET / HTTP/9.9\r\n\r\n",
        "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    ] {
        assert!(server.raw(nonsense.as_bytes()).is_none_or(|reply| reply.status >= 400), "{nonsense:?}");
    }
    assert_eq!(server.get("/api/start", &[]).status, 200);
}

#[test]
fn json_of_another_shape_is_named_and_refused() {
    let server = Running::new();
    let id = server.model(&json!({ "family": "hydra(3)" }))["id"].as_str().unwrap().to_owned();
    let deep = |open: &str, n: usize| format!(r#"{{"id":"{id}","q":{}"#, open.repeat(n));
    let bodies = [
        String::new(),
        "null".into(),
        "[]".into(),
        "7".into(),
        "\"id\"".into(),
        "{".into(),
        "{}".into(),
        deep("[", 100_000),
        deep("{\"a\":", 40_000),
        format!(r#"{{"id":"{id}","q":[0,0,0],"more":1}}"#),
        format!(r#"{{"id":"{id}","id":"{id}","q":[0,0,0]}}"#),
        format!(r#"{{"id":{id},"q":[0,0,0]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,"0"]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,null]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,NaN]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,Infinity]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,1e999]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,0],"want":["everything"]}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,0],"pool":-1}}"#),
        format!(r#"{{"id":"{id}","q":[0,0,0],"pool":1e30}}"#),
        format!("{{\"id\":\"{id}\",\"q\":[0,0,0]}} trailing"),
    ];
    for body in &bodies {
        let reply = server.post_text("/api/evaluate", body);
        assert_eq!(reply.refusal(), (400, "json".into()), "{}", &body[..body.len().min(80)]);
        assert!(reply.message().starts_with("the body is no such JSON: "), "{}", reply.message());
    }
    let not_utf8 = [b"{\"id\":\"" as &[u8], &[0xff, 0xfe], b"\"}"].concat();
    let length = not_utf8.len().to_string();
    let host = server.host();
    let headers = [
        ("Host", host.as_str()),
        ("X-Eigenbody-Token", &server.token),
        ("Content-Type", "application/json"),
        ("Content-Length", &length),
    ];
    assert_eq!(server.request("POST", "/api/evaluate", &headers, &not_utf8).refusal(), (400, "json".into()));
}

#[test]
fn what_does_not_fit_the_robot_is_one_clear_line() {
    let server = Running::new();
    let model = server.model(&json!({ "family": "auto_tree(8, 1.5, 0.3, 0.9)" }));
    let (id, q0) = (&model["id"], &model["q0"]);
    let v = vec![0.1; model["nv"].as_u64().unwrap() as usize];
    let mut turned = q0.as_array().unwrap().clone();
    let w = model["coordinates"].as_array().unwrap().iter().position(|c| c["unit"] == "1").unwrap();
    turned[w] = json!(0.5);
    let cases = [
        ("evaluate", json!({ "id": id, "q": [] }), "q has 0 numbers, expected 21"),
        ("evaluate", json!({ "id": id, "q": vec![0.0; 22] }), "q has 22 numbers, expected 21"),
        ("evaluate", json!({ "id": id, "q": turned }), "expected a unit quaternion w, x, y, z"),
        ("evaluate", json!({ "id": id, "q": q0, "metric": "furlongs" }), "expected euclidean, unit-diagonal"),
        ("evaluate", json!({ "id": id, "q": q0, "metric": "length=0" }), "expected a positive number"),
        ("evaluate", json!({ "id": id, "q": q0, "metric": "diagonal=[1]" }), "expected"),
        ("pose", json!({ "id": id, "at": "zig(1)" }), "expected zero, zag(angle)"),
        ("pose", json!({ "id": id, "at": "zag(1e999)" }), "zag(1e999)"),
        ("move", json!({ "id": id, "q": q0, "v": [] }), "v has 0 numbers"),
        ("move", json!({ "id": id, "q": q0 }), "a move has v, or to and t"),
        ("move", json!({ "id": id, "q": q0, "v": v, "to": q0, "t": 1 }), "a move has v, or to and t"),
        ("swing", json!({ "id": id, "q": q0, "mode": "softest", "frames": 100_000 }), "at most"),
        ("swing", json!({ "id": id, "q": q0, "mode": { "rates": [1] } }), "x has 1 number,"),
        ("path", json!({ "id": id, "from": q0, "to": [] }), "q has 0 numbers"),
        ("path", json!({ "id": id, "from": q0, "to": q0, "points": 1_000_000_000 }), "expected 2 to 400"),
        ("path", json!({ "id": id, "from": q0, "to": q0, "points": 0 }), "expected 2 to 400"),
        ("map", json!({ "id": id, "q": q0, "dofs": [0, 1], "resolution": 100_000 }), "expected 2 to 64"),
        ("map", json!({ "id": id, "q": q0, "dofs": [0, 0] }), "two different joints"),
        ("map", json!({ "id": id, "q": q0, "dofs": [0, 6] }), "joint 6 is no joint of one coordinate"),
        ("map", json!({ "id": id, "q": q0, "dofs": [0, 99] }), "joint 99 is no joint of one coordinate"),
        ("check", json!({ "id": id, "samples": 0 }), "expected 1 to 8192"),
        ("check", json!({ "id": id, "samples": 4_000_000_000u32 }), "expected 1 to 8192"),
    ];
    for (path, body, expected) in cases {
        let reply = server.post(&format!("/api/{path}"), &body);
        assert_eq!(reply.refusal(), (422, "input".into()), "{path} {body}: {}", reply.text());
        assert!(reply.message().contains(expected), "{path}: {}", reply.message());
    }
    let source = json!({ "family": "hydra(3)" });
    let edits = [
        (json!({ "mass": { "nobody": 1 } }), "no moving link is named 'nobody'"),
        (json!({ "mass": { "link_2": 0 } }), "expected a positive number"),
        (json!({ "mass": { "link_2": -1 } }), "expected a positive number"),
        (json!({ "armature": { "joint_2": -1e-9 } }), "zero or more"),
        (json!({ "armature": { "elbow": 1 } }), "no degree of freedom is named 'elbow'"),
    ];
    for (edits, expected) in edits {
        let reply = server.post("/api/model", &json!({ "source": source, "edits": edits }));
        assert_eq!(reply.refusal(), (422, "input".into()), "{edits}");
        assert!(reply.message().contains(expected), "{}", reply.message());
    }
    let reduced = json!({ "source": source, "options": { "reduced": true } });
    assert!(server.post("/api/model", &reduced).message().contains("no floating base"));
    assert_eq!(server.post("/api/evaluate", &json!({ "id": "no", "q": [] })).refusal(), (404, "gone".into()));
}

/// Finite, and out of all proportion.
#[test]
fn enormous_numbers_are_answered_or_refused() {
    let server = Running::new();
    let want = json!(["places", "numbers", "modes", "eigenvalues", "matrix"]);
    for family in [
        "hydra(4, 1, 0.3, 1)",
        "auto_tree(6, 1, 0.3, 1)",
        "hydra(4, 1, 0, 1e-30)",
        "chain(3, m=1e200, l=1e100)",
    ] {
        let reply = server.post("/api/model", &json!({ "source": { "family": family } }));
        if reply.status == 422 {
            continue;
        }
        let model = reply.json();
        for size in [1e308, -1e300, 1e150, 1e18, 1e-308, 5e-324] {
            let mut q = model["q0"].as_array().unwrap().clone();
            for (q, coordinate) in q.iter_mut().zip(model["coordinates"].as_array().unwrap()) {
                if coordinate["unit"] != "1" {
                    *q = json!(size);
                }
            }
            let questions = [
                ("evaluate", json!({ "id": model["id"], "q": q, "want": want })),
                ("swing", json!({ "id": model["id"], "q": q, "mode": "softest", "amplitude": 1e300 })),
                ("move", json!({ "id": model["id"], "q": model["q0"], "to": q, "t": 1e300 })),
                ("path", json!({ "id": model["id"], "from": model["q0"], "to": q, "points": 5 })),
                ("map", json!({ "id": model["id"], "q": q, "dofs": [0, 1], "resolution": 3 })),
            ];
            for (path, body) in questions {
                let reply = server.post(&format!("/api/{path}"), &body);
                assert!(matches!(reply.status, 200 | 422), "{family} {size} {path}: {}", reply.text());
            }
        }
    }
}

#[test]
fn robots_that_are_too_large_are_refused_before_they_are_built() {
    let server = Running::new();
    let most = server.get("/api/start", &[]).json()["limits"]["dofs"].as_u64().unwrap();
    let families = [
        ("hydra(1e9, 1, 0, 1)", "whole number from 1 to 10000000"),
        ("hydra(1e300, 1, 0, 1)", "whole number"),
        ("hydra(10000000, 1, 0, 1)", "the explorer takes up to 2048"),
        ("auto_tree(2048, 1, 0, 1)", "the explorer takes up to 2048"),
        ("onion(2049, 1, 0, 1)", "the explorer takes up to 2048"),
    ];
    for (family, expected) in families {
        let reply = server.post("/api/model", &json!({ "source": { "family": family } }));
        assert_eq!(reply.refusal(), (422, "model".into()), "{family}");
        assert!(reply.message().contains(expected), "{}", reply.message());
    }
    let largest = server.model(&json!({ "family": format!("hydra({most}, 1, 0, 1)") }));
    let all = server.ask(
        "/api/evaluate",
        &json!({ "id": largest["id"], "q": largest["q0"], "want": ["numbers", "eigenvalues", "matrix"] }),
    );
    assert!(all["kappa"].as_f64().unwrap() > 1e12 && all["eigenvalues"].is_null() && all["matrix"].is_null());
    let nested = |n: usize| format!("hydra({}3{})", "(".repeat(n), ")".repeat(n));
    for family in [
        nested(80),
        nested(5000),
        "hydra(".repeat(30),
        "x".repeat(100_000),
        "hydra(3,,,)".into(),
        "hydra(nan)".into(),
    ] {
        let reply = server.post("/api/model", &json!({ "source": { "family": family } }));
        assert_eq!(reply.status, 422, "{}", &family[..family.len().min(60)]);
    }
}

#[test]
fn texts_that_grow_are_refused() {
    let server = Running::new();
    let nested = |n: usize, tag: &str| {
        format!("<robot name='r'>{}{}</robot>", format!("<{tag}>").repeat(n), format!("</{tag}>").repeat(n))
    };
    let replicate = |n: usize, depth: usize| {
        let (open, close) = (format!("<replicate count='{n}'>").repeat(depth), "</replicate>".repeat(depth));
        format!("<mujoco><worldbody>{open}<body><joint/><geom size='1'/></body>{close}</worldbody></mujoco>")
    };
    let texts = [
        nested(100_000, "link"),
        replicate(1_000_000_000, 1),
        replicate(1000, 8),
        replicate(100_000, 1),
        format!("<mujoco>{}</mujoco>", "<worldbody>".repeat(1000)),
        format!("<sdf version='1.9'><model name='m'>{}</model></sdf>", "<link/>".repeat(100_000)),
        "<a/>".repeat(900_000),
        format!("<robot name='r'>{}</robot>", "<a/>".repeat(900_000)),
        format!("<robot name='{}'/>", "r".repeat(3_000_000)),
        "<".repeat(3_000_000),
        "\u{0}".repeat(1000),
    ];
    for text in texts {
        let reply = server.post("/api/model", &json!({ "source": { "text": text, "name": "x.xml" } }));
        assert_eq!(
            reply.refusal(),
            (422, "model".into()),
            "{}: {}",
            &text[..text.len().min(60)],
            reply.text()
        );
        assert!(reply.body.len() < 64 * 1024, "an answer of {} bytes", reply.body.len());
    }
}

/// Accidents of all kinds: one number, name or bracket of a good request is something else.
#[test]
fn three_thousand_broken_requests() {
    let server = Running::new();
    let model = server.model(&json!({ "family": "hydra(3, 1, 0.2, 1)" }));
    let (id, q) = (&model["id"], json!([0.1, -0.2, 0.3]));
    let good: Vec<(&str, Value)> = vec![
        (
            "model",
            json!({ "source": { "family": "hydra(3, 1, 0.2, 1)" }, "edits": { "mass": { "link_2": 2 } } }),
        ),
        (
            "model",
            json!({ "source": { "text": "<robot name='r'><link name='a'/></robot>", "name": "r.urdf" }, "options": { "base": "floating" } }),
        ),
        (
            "evaluate",
            json!({ "id": id, "q": q, "metric": "length=0.3", "want": ["numbers", "matrix"], "pool": 2 }),
        ),
        ("pose", json!({ "id": id, "at": "zag(pi/2)" })),
        ("move", json!({ "id": id, "q": q, "to": q, "t": 0.5 })),
        ("swing", json!({ "id": id, "q": q, "mode": { "rates": [1, 2, 3] }, "frames": 3 })),
        ("path", json!({ "id": id, "from": q, "to": [0, 0, 0], "points": 3 })),
        ("map", json!({ "id": id, "q": q, "dofs": [0, 2], "resolution": 3 })),
        ("patch", json!({ "id": id, "format": "mjcf" })),
    ];
    let mut random = Random::new(7);
    let mut pick = |n: usize| (random.between(0.0, n as f64) as usize).min(n - 1);
    let scraps = [
        "\"", "{", "}", "[", "]", ",", ":", "-", "0", "9", "1e308", "null", "true", "\\", "é", "\u{1}", "(",
        ")", "pi",
    ];
    let mut seen = std::collections::BTreeMap::new();
    for _ in 0..3000 {
        let (path, body) = &good[pick(good.len())];
        let mut text: Vec<char> = body.to_string().chars().collect();
        for _ in 0..=pick(3) {
            let at = pick(text.len());
            match pick(3) {
                0 => drop(text.remove(at)),
                1 => text.splice(at..at, scraps[pick(scraps.len())].chars()).for_each(drop),
                _ => text.splice(at..=at, scraps[pick(scraps.len())].chars()).for_each(drop),
            }
        }
        let text: String = text.into_iter().collect();
        let reply = server.post_text(&format!("/api/{path}"), &text);
        assert!(reply.status < 500, "{path} {text}: {}", reply.text());
        *seen.entry(reply.status).or_insert(0) += 1;
    }
    // Most are noticed as JSON, some as numbers that do not fit, some are harmless.
    assert!(seen[&200] > 30 && seen[&400] > 500 && seen[&422] > 50, "{seen:?}");
}
