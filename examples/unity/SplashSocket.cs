// SPDX-License-Identifier: MIT
// The way to a simulator and back: asks for events, listens on a thread of its own, and hands what
// came to whoever calls Take, in Unity the main thread.
using System;
using System.Collections.Concurrent;
using System.Net;
using System.Net.Sockets;
using System.Threading;

public sealed class SplashSocket : IDisposable
{
    const int AskEvery = 20000;                  // ms; the simulator forgets who asked after a minute
    readonly UdpClient socket;
    readonly IPEndPoint simulator;
    readonly Thread thread;
    readonly ConcurrentQueue<SplashMessage> came = new ConcurrentQueue<SplashMessage>();
    volatile bool ends;

    public SplashSocket(string host, int port, bool wantsEvents)
    {
        // Not connected: events come from another port than the one that is asked.
        socket = new UdpClient(0);
        foreach (var address in Dns.GetHostAddresses(host))
            if (address.AddressFamily == AddressFamily.InterNetwork) simulator = new IPEndPoint(address, port);
        if (simulator == null) throw new ArgumentException("no host called " + host);
        socket.Client.ReceiveTimeout = 200;
        if (!wantsEvents) return;
        thread = new Thread(Listen) { IsBackground = true };
        thread.Start();
    }

    public void Send(string address, params object[] arguments)
    {
        byte[] packet = SplashOsc.Build(address, arguments);
        try { socket.Send(packet, packet.Length, simulator); }
        catch (SocketException) { }              // nobody listens there, or not yet
    }

    /// The next message that came; false: none is left.
    public bool Take(out SplashMessage message) { return came.TryDequeue(out message); }

    public void Dispose()
    {
        ends = true;
        if (thread != null) { thread.Join(); Send("/notify", 0); }
        socket.Close();
    }

    void Listen()
    {
        int asked = Environment.TickCount - AskEvery;
        while (!ends)
        {
            if (Environment.TickCount - asked >= AskEvery) { Send("/notify", 1); asked = Environment.TickCount; }
            try
            {
                var from = new IPEndPoint(IPAddress.Any, 0);
                byte[] packet = socket.Receive(ref from);
                if (!from.Address.Equals(simulator.Address)) continue;
                foreach (var message in SplashOsc.Parse(packet)) came.Enqueue(message);
            }
            catch (SocketException)              // silence, or nobody there: ask again in a second
            {
                if (Environment.TickCount - asked > 1000) asked = Environment.TickCount - AskEvery;
            }
        }
    }
}
