//! Many clients at once.

use crate::client::{Running, read};
use serde_json::{Value, json};
use std::io::{BufReader, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

const CLIENTS: usize = 100;
const TIME: Duration = Duration::from_secs(10);

/// Memory of this process, server and clients, in bytes.
#[cfg(target_os = "linux")]
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/statm").unwrap();
    status.split(' ').nth(1).unwrap().parse::<usize>().unwrap() * 4096
}

#[cfg(not(target_os = "linux"))]
fn resident() -> usize {
    0
}

/// A hundred pages that drag sliders for ten seconds, and change the robot now and then: every answer is good, and memory is bounded by
/// the cache of models, not by the number of requests.
#[test]
fn a_hundred_clients_for_ten_seconds() {
    let server = Running::new();
    let (host, token) = (server.host(), server.token.clone());
    let robots = [
        "hydra(7, 1, 0.3, 1)",
        "hydra(40, 1, 0.1, 1)",
        "onion(20, 1.5, 0.3, 0.9)",
        "auto_tree(12, 1.5, 0.3, 0.9)",
    ];
    let request = |path: &str, body: &Value| {
        let body = body.to_string();
        format!(
            "POST /api/{path} HTTP/1.1\r\nHost: {host}\r\nX-Eigenbody-Token: {token}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        )
    };
    let answered = AtomicUsize::new(0);
    let (before, mut most) = (resident(), 0);
    let began = Instant::now();
    std::thread::scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS)
            .map(|client| {
                let (server, request, answered) = (&server, &request, &answered);
                scope.spawn(move || {
                    let mut stream = BufReader::new(server.connect());
                    let mut ask = |path: &str, body: Value| {
                        stream.get_mut().write_all(request(path, &body).as_bytes()).unwrap();
                        let reply = read(&mut stream).expect("the connection lasts");
                        assert_eq!(reply.status, 200, "{path}: {}", reply.text());
                        answered.fetch_add(1, Ordering::Relaxed);
                        reply.json()
                    };
                    let mut round = 0u64;
                    while began.elapsed() < TIME {
                        // Eighty robots in all, made by whoever asks first.
                        let mass = 1.0 + ((client as u64 + round) % 20) as f64 / 10.0;
                        let source = json!({ "family": robots[(client + round as usize) % robots.len()] });
                        let model = ask(
                            "model",
                            json!({ "source": source, "edits": { "mass": { "link_2": mass } } }),
                        );
                        for step in 0..20 {
                            let at = format!("random({})", round * 20 + step);
                            let q = ask("pose", json!({ "id": model["id"], "at": at }))["q"].clone();
                            let want = json!(["places", "numbers", "modes", "eigenvalues", "matrix"]);
                            let found = ask("evaluate", json!({ "id": model["id"], "q": q, "want": want }));
                            assert!(found["kappa"].as_f64().unwrap() >= 1.0);
                        }
                        round += 1;
                    }
                    round
                })
            })
            .collect();
        while began.elapsed() < TIME {
            most = most.max(resident());
            std::thread::sleep(Duration::from_millis(100));
        }
        for client in clients {
            assert!(client.join().unwrap() > 0, "every client got its turn");
        }
    });
    let grown = most.saturating_sub(before);
    eprintln!("{} answers, {} MB more at most", answered.into_inner(), grown >> 20);
    assert!(grown < 200 << 20, "grew by {} MB", grown >> 20);
}
