//! A server in this process, and a client that says what it is told to.

use eigenbody_web::{Opening, Server, Stopper};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::net::{SocketAddr, TcpStream};
use std::thread::JoinHandle;
use std::time::Duration;

/// A running server; it ends when this is dropped.
pub struct Running {
    pub address: SocketAddr,
    pub token: String,
    stop: Stopper,
    thread: Option<JoinHandle<std::io::Result<()>>>,
}

/// What came back.
#[derive(Debug, Clone)]
pub struct Reply {
    pub status: u16,
    /// Names in small letters.
    pub headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Reply {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).expect("JSON")
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|header| header.0 == name).map(|header| header.1.as_str())
    }

    /// Status and code of a refusal.
    pub fn refusal(&self) -> (u16, String) {
        (self.status, self.json()["error"]["code"].as_str().unwrap_or_default().to_owned())
    }

    /// The one line of a refusal.
    pub fn message(&self) -> String {
        let message = self.json()["error"]["message"].as_str().unwrap().to_owned();
        assert_eq!(message.lines().count(), 1, "{message}");
        message
    }
}

impl Running {
    pub fn new() -> Self {
        Self::with(Opening::default())
    }

    pub fn with(opening: Opening) -> Self {
        let server = Server::bind(0, opening).unwrap();
        let (address, stop) = (server.address(), server.stopper());
        let thread = Some(std::thread::spawn(move || server.run()));
        let mut running = Self { address, token: String::new(), stop, thread };
        let page = running.get("/", &[]).text();
        let (_, rest) = page.split_once("name=\"eigenbody-token\" content=\"").unwrap();
        running.token = rest.split('"').next().unwrap().to_owned();
        running
    }

    pub fn host(&self) -> String {
        self.address.to_string()
    }

    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream
    }

    /// Sends these bytes on a connection of their own; none if the server closes it without a word.
    pub fn raw(&self, bytes: &[u8]) -> Option<Reply> {
        let mut stream = self.connect();
        // It may refuse before all is sent.
        let _ = stream.write_all(bytes);
        read(&mut BufReader::new(stream))
    }

    /// A request with exactly these headers.
    pub fn request(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &[u8]) -> Reply {
        let mut bytes = format!("{method} {path} HTTP/1.1\r\n").into_bytes();
        for (name, value) in headers {
            bytes.extend(format!("{name}: {value}\r\n").bytes());
        }
        bytes.extend(b"Connection: close\r\n\r\n");
        bytes.extend(body);
        self.raw(&bytes).expect("an answer")
    }

    /// A GET as the page would send it, and some headers more.
    pub fn get(&self, path: &str, more: &[(&str, &str)]) -> Reply {
        let host = self.host();
        let own = [("Host", host.as_str()), ("X-Eigenbody-Token", &self.token)];
        self.request("GET", path, &[&own, more].concat(), b"")
    }

    /// A POST as the page would send it, of any text.
    pub fn post_text(&self, path: &str, body: &str) -> Reply {
        let (host, length, origin) = (self.host(), body.len().to_string(), format!("http://{}", self.host()));
        let headers = [
            ("Host", host.as_str()),
            ("Origin", &origin),
            ("Sec-Fetch-Site", "same-origin"),
            ("X-Eigenbody-Token", &self.token),
            ("Content-Type", "application/json"),
            ("Content-Length", &length),
        ];
        self.request("POST", path, &headers, body.as_bytes())
    }

    pub fn post(&self, path: &str, body: &Value) -> Reply {
        self.post_text(path, &body.to_string())
    }

    /// The answer to a question that has one.
    pub fn ask(&self, path: &str, body: &Value) -> Value {
        let reply = self.post(path, body);
        assert_eq!(reply.status, 200, "{path} {body}: {}", reply.text());
        reply.json()
    }

    /// The description of a model.
    pub fn model(&self, source: &Value) -> Value {
        self.ask("/api/model", &json!({ "source": source }))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop.stop();
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            if !std::thread::panicking() {
                ended.unwrap().unwrap();
            }
        }
    }
}

/// One answer; none at the end of the stream.
pub fn read(stream: &mut impl BufRead) -> Option<Reply> {
    let mut line = String::new();
    if stream.read_line(&mut line).unwrap_or(0) == 0 {
        return None;
    }
    let status = line.split(' ').nth(1)?.parse().ok()?;
    let mut headers = Vec::new();
    loop {
        let mut line = String::new();
        stream.read_line(&mut line).ok()?;
        let Some((name, value)) = line.trim_end().split_once(':') else { break };
        headers.push((name.to_lowercase(), value.trim().to_owned()));
    }
    let mut reply = Reply { status, headers, body: Vec::new() };
    let length = reply.header("content-length").map_or(0, |length| length.parse().unwrap());
    reply.body = vec![0; length];
    stream.read_exact(&mut reply.body).ok()?;
    Some(reply)
}
