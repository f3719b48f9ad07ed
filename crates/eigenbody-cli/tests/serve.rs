//! `eigenbody serve`: the address, a question, an end.

use crate::run::failure;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Command, Stdio};

#[test]
fn it_prints_its_address_answers_and_ends() {
    let mut server = Command::new(env!("CARGO_BIN_EXE_eigenbody"))
        .args(["serve", "hydra(3, 1, 0, 1)"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
    let address = line.trim().strip_prefix("http://").and_then(|rest| rest.strip_suffix('/')).unwrap();
    assert!(address.starts_with("127.0.0.1:"), "{line}");
    let ask = |path: &str, token: &str| {
        let mut stream = TcpStream::connect(address).unwrap();
        let head = format!(
            "GET {path} HTTP/1.1\r\nHost: {address}\r\nX-Eigenbody-Token: {token}\r\nConnection: close\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer
    };
    let page = ask("/", "");
    let (_, rest) = page.split_once("name=\"eigenbody-token\" content=\"").unwrap();
    let start = ask("/api/start", rest.split('"').next().unwrap());
    assert!(start.contains(r#""source":{"family":"hydra(3, 1, 0, 1)"}"#), "{start}");
    // As Ctrl-C does.
    #[cfg(unix)]
    {
        let interrupt = Command::new("kill").args(["-INT", &server.id().to_string()]).status().unwrap();
        assert!(interrupt.success());
        let output = server.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1);
    }
    #[cfg(not(unix))]
    server.kill().unwrap();
}

#[test]
fn what_cannot_be_served_is_one_line() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let message = failure(&["serve", "--port", &port.to_string()]);
    assert!(message.starts_with(&format!("error: 127.0.0.1:{port}: ")), "{message}");
    assert!(failure(&["serve", "hydra(0)"]).contains("N = 0"));
    assert!(failure(&["serve", "no_such.urdf"]).contains("no such file"));
}
